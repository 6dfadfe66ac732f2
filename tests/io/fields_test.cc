#include <plastron/io/fields.hpp>
#include <plastron/io/quantities.hpp>

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace plastron::io {

namespace {

TEST(Fields, have_names_that_occur_once) {
  std::set<std::string_view> keys, arrays;
  for (const Field& field : fields()) {
    EXPECT_TRUE(keys.insert(field.key).second) << field.key;
    for (const std::string& name : field.arrays) EXPECT_TRUE(arrays.insert(name).second) << name;
  }
}

TEST(Fields, have_a_unit_a_symbol_and_a_meaning) {
  for (const Field& field : fields()) {
    EXPECT_FALSE(field.unit.empty()) << field.key;
    EXPECT_FALSE(field.symbol.empty()) << field.key;
    EXPECT_FALSE(field.meaning.empty()) << field.key;
    ASSERT_NE(field.take, nullptr) << field.key;
  }
}

TEST(Fields, are_one_vector_or_one_array_a_component) {
  for (const Field& field : fields())
    EXPECT_TRUE(field.is_vector() || field.arrays.size() == static_cast<std::size_t>(field.components)) << field.key;
}

TEST(Fields, without_obstacle_tell_nothing_of_contact) {
  std::set<std::string_view> missing;
  for (const Field& field : fields()) missing.insert(field.key);
  for (const Field& field : fields_of({.multiplier = true, .foundation = true})) missing.erase(field.key);
  EXPECT_EQ(missing, (std::set<std::string_view>{"gap", "eta", "contact"}));
}

TEST(Fields, without_multiplier_tell_nothing_of_lambda) {
  std::set<std::string_view> missing;
  for (const Field& field : fields()) missing.insert(field.key);
  for (const Field& field : fields_of({.obstacle = true, .foundation = true})) missing.erase(field.key);
  EXPECT_EQ(missing, (std::set<std::string_view>{"lambda"}));
}

/// The last step of a path.
std::string last_name(std::string_view path) { return std::string(path.substr(path.rfind('/') + 1)); }

template <class Record>
void add_units(std::span<const Quantity<Record>> quantities, std::map<std::string, std::set<std::string_view>>& units) {
  for (const auto& q : quantities) units[last_name(q.path)].insert(q.unit);
}

TEST(Fields, a_force_and_a_pressure_never_share_a_name) {
  std::map<std::string, std::set<std::string_view>> units;
  add_units(result_quantities(), units);
  add_units(rigid_body_quantities(), units);
  add_units(contact_quantities(), units);
  add_units(admissible_quantities(), units);
  add_units(obstacle_quantities(), units);
  add_units(certificate_quantities(), units);
  add_units(level_quantities(), units);
  add_units(iteration_quantities(), units);
  for (const Field& field : fields())
    for (const std::string& name : {field.key, field.arrays.front()}) units[last_name(name)].insert(field.unit);
  for (const auto& [name, of_name] : units) EXPECT_EQ(of_name.size(), 1U) << name << " has more than one unit";
}

TEST(Fields, keep_contact_between_nodes_within_0_and_1) {
  bool is_there = false;
  for (const Field& field : fields())
    if (field.key == "contact") {
      is_there = true;
      recovery::PointValues p{};
      p.touching = 1.125;
      EXPECT_EQ(field.take(p)[0], 1);
      p.touching = -0.125;
      EXPECT_EQ(field.take(p)[0], 0);
    }
  EXPECT_TRUE(is_there);
}

}  // namespace

}  // namespace plastron::io
