// Reads [[rigid_body]].
#include <plastron/config/named_values.hpp>
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

const std::vector<std::string>& body_components() {
  static const std::vector<std::string> all{"u.x", "u.y", "u.z", "theta.x", "theta.y", "theta.z"};
  return all;
}

std::size_t body_component(const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(body_components(), name) - body_components().begin());
}

void read_body_fix(Table& table, fem::RigidBody& body) {
  const auto words = table.texts("fix");
  if (!words) return;
  for (std::size_t i = 0; i < words->size(); ++i)
    for (const char* axis : {".x", ".y", ".z"}) {
      const std::string& word = (*words)[i];
      const bool is_vector = word == "u" || word == "theta";
      if (!is_vector && axis[1] != 'x') break;
      auto& value = body.fixed[body_component(is_vector ? word + axis : word)];
      if (value) {
        const toml::value list = table.value("fix").value();
        table.reading().report(table.reading().source.value(list.as_array()[i]),
                               fmt::format("{} is fixed twice", is_vector ? word + axis : word));
        break;
      }
      value = 0;
    }
}

void read_body_values(Table& table, fem::RigidBody& body) {
  const toml::value given = table.value("values").value();
  Reading& reading = table.reading();
  if (!given.is_table()) return report_kind(reading, Item{given, "values"}, Kind::table);
  std::vector<std::string> allowed;
  for (std::size_t k = 0; k < 6; ++k)
    if (body.fixed[k]) allowed.push_back(body_components()[k]);
  for (const auto& [name, value] : named_values(reading, given, {"u", "theta"})) {
    if (std::ranges::find(allowed, name) == allowed.end())
      reading.report(reading.source.value(value),
                     fmt::format("values gives {}, which fix does not name", geometry::shortened(name)),
                     joined(allowed), did_you_mean(name, allowed));
    else if (const auto number = read_number(reading, Item{value, name}))
      body.fixed[body_component(name)] = *number;
  }
}

void check_body_name(const Table& table, const std::vector<fem::RigidBody>& before, const std::string& name) {
  if (std::ranges::find(before, name, &fem::RigidBody::name) != before.end())
    table.report("name", fmt::format("there is a rigid body \"{}\" already", name), "a name no other body has");
}

}  // namespace

void read_rigid_bodies(Table& root, const std::optional<fem::Domain>& domain, problem::Problem& problem) {
  auto& effective = root.effective["rigid_body"] = nlohmann::json::array();
  for (Table& table : root.tables("rigid_body")) {
    fem::RigidBody body{.name = table.text("name").value_or("")};
    check_body_name(table, problem.rigid_bodies, body.name);
    body.boundaries = read_boundaries(table, domain).value_or(std::vector<std::string>{});
    body.reference = table.vector("reference").value_or(Eigen::Vector3d::Zero());
    body.turns_normals = table.boolean("rotations").value_or(true);
    read_body_fix(table, body);
    read_body_values(table, body);
    auto& values = table.effective["values"] = nlohmann::json::object();
    for (std::size_t k = 0; k < 6; ++k)
      if (body.fixed[k]) values[body_components()[k]] = *body.fixed[k];
    body.force = table.vector("force").value_or(Eigen::Vector3d::Zero());
    body.moment = table.vector("moment").value_or(Eigen::Vector3d::Zero());
    effective.push_back(table.effective);
    problem.rigid_bodies.push_back(std::move(body));
  }
}

}  // namespace plastron::config
