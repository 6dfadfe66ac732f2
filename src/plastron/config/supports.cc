// [[support]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>
#include <map>

namespace plastron::config {

namespace {

using assembly::Direction;
using assembly::Unknown;

// "u.x" and its like; "u" and "r" are the three Cartesian components, "symmetry" is u.n and r.n.
std::vector<std::string> components_of(const std::string& word) {
  if (word == "u" || word == "r") return {word + ".x", word + ".y", word + ".z"};
  if (word == "symmetry") return {"u.n", "r.n"};
  return {word};
}

assembly::PrescribedComponent component(const std::string& name) {
  static const std::map<std::string, Direction> directions{{"x", Direction::x},       {"y", Direction::y},
                                                           {"z", Direction::z},       {"n", Direction::conormal},
                                                           {"t", Direction::tangent}, {"a3", Direction::normal}};
  return {name[0] == 'u' ? Unknown::displacement : Unknown::rotation, directions.at(name.substr(2)), {}};
}

struct Fixed {
  std::string name;
  bool by_symmetry;
};

// What earlier words and sections fixed on each boundary.
using FixedOn = std::map<std::string, std::vector<std::string>>;

bool check_new(Reading& reading, const toml::value& word, const std::string& boundary, const std::string& name,
               const std::vector<std::string>& before) {
  const Place place = reading.source.value(word);
  if (std::ranges::count(before, name) > 0) {
    reading.report(place, fmt::format("{} is fixed twice on \"{}\"", name, boundary));
    return false;
  }
  if (std::ranges::count(before, name[0], [](const std::string& other) { return other[0]; }) < 3) return true;
  reading.report(
      place, fmt::format("{} on \"{}\": three other components of {} are fixed there already", name, boundary, name[0]),
      "at most three components of each of u and r on a boundary");
  return false;
}

std::optional<std::vector<Fixed>> read_fix(Table& support, const std::string& boundary, FixedOn& fixed_on) {
  const auto words = support.texts("fix");
  if (!words) return {};
  if (words->empty())
    support.report("fix", "fix names no component", joined(available_names(section("support").keys[1].words)));
  const toml::value list = support.value("fix").value();
  std::vector<Fixed> fixed;
  for (std::size_t i = 0; i < words->size(); ++i)
    for (const std::string& name : components_of((*words)[i])) {
      if (!check_new(support.reading(), list.as_array()[i], boundary, name, fixed_on[boundary])) break;
      fixed_on[boundary].push_back(name);
      fixed.push_back({name, (*words)[i] == "symmetry"});
    }
  return fixed;
}

struct NamedValue {
  std::string name;
  toml::value value;
};

// u and r are vectors: one number, or a list of other than three, does not say which component is meant.
bool names_no_component(Reading& reading, const std::string& name, const toml::value& value) {
  if ((name != "u" && name != "r") || value.is_table()) return false;
  if (value.is_array() && value.as_array().size() == 3) return false;
  reading.report(reading.source.value(value),
                 value.is_array() ? fmt::format("{} has {} entries, but must have 3", name, value.as_array().size())
                                  : fmt::format("{} is a vector, and one value does not say which component", name),
                 fmt::format("{0}.x = ..., {0}.n = ... and their like, or {0} = [three values]", name),
                 fmt::format("for example values = {{ {0}.z = -0.02 }} or values = {{ {0} = [0, 0, -0.02] }}", name));
  return true;
}

// { u.z = 1 }, { "u.z" = 1 } and { u = [0, 0, 1] } name components in the same way.
std::vector<NamedValue> named_values(Reading& reading, const toml::value& table) {
  std::vector<NamedValue> all;
  for (const auto& [name, value] : entries(reading, table)) {
    if (names_no_component(reading, name, value)) continue;
    if (value.is_table()) {
      for (const auto& [direction, inner] : entries(reading, value))
        all.push_back({fmt::format("{}.{}", name, direction), inner});
    } else if (value.is_array() && (name == "u" || name == "r")) {
      for (std::size_t i = 0; i < 3; ++i) all.push_back({fmt::format("{}.{}", name, "xyz"[i]), value.as_array()[i]});
    } else {
      all.push_back({name, value});
    }
  }
  return all;
}

void read_values(const Table& support, const std::vector<Fixed>& fixed, assembly::Support& result,
                 nlohmann::json& effective) {
  const toml::value table = support.value("values").value();
  Reading& reading = support.reading();
  if (!table.is_table()) return report_kind(reading, Item{table, "values"}, Kind::table);
  std::vector<std::string> allowed, seen;
  for (const Fixed& component : fixed)
    if (!component.by_symmetry) allowed.push_back(component.name);
  for (const auto& [name, value] : named_values(reading, table)) {
    const auto at = std::ranges::find(fixed, name, &Fixed::name);
    const Place place = reading.source.value(value);
    if (at == fixed.end() || at->by_symmetry) {
      reading.report(place, fmt::format("values gives {}, which fix does not name", geometry::shortened(name)),
                     joined(allowed), did_you_mean(name, allowed));
    } else if (std::ranges::count(seen, name) > 0) {
      reading.report(place, fmt::format("values gives {} twice", geometry::shortened(name)));
    } else if (auto field = read_field(reading, Item{value, name})) {
      effective[name] = as_json(*field);
      result.components[static_cast<std::size_t>(at - fixed.begin())].value = std::move(*field);
    }
    seen.push_back(name);
  }
}

}  // namespace

std::optional<std::string> read_boundary(Table& table, const std::optional<fem::Domain>& domain) {
  auto boundary = table.text("boundary");
  if (!boundary) return {};
  if (boundary->empty()) {
    table.report("boundary", "the boundary has no name");
    return {};
  }
  const auto known = domain ? fem::boundary_names(*domain) : std::vector<std::string>{};
  if (known.empty() || std::ranges::count(known, *boundary) > 0) return boundary;
  table.report("boundary", fmt::format("the domain has no boundary \"{}\"", *boundary), joined(known),
               did_you_mean(*boundary, known));
  return {};
}

void read_supports(Table& root, const std::optional<fem::Domain>& domain, computation::Problem& problem) {
  auto& effective = root.effective["support"] = nlohmann::json::array();
  FixedOn fixed_on;
  for (Table& support : root.tables("support")) {
    const auto boundary = read_boundary(support, domain);
    FixedOn elsewhere;
    const auto fixed = read_fix(support, boundary.value_or(""), boundary ? fixed_on : elsewhere);
    if (!fixed) continue;
    assembly::Support result{boundary.value_or(""), {}};
    for (const Fixed& f : *fixed) {
      result.components.push_back(component(f.name));
      result.symmetry = result.symmetry || f.by_symmetry;
    }
    auto& values = support.effective["values"] = nlohmann::json::object();
    for (const Fixed& f : *fixed)
      if (!f.by_symmetry) values[f.name] = 0.0;
    read_values(support, *fixed, result, values);
    effective.push_back(support.effective);
    problem.supports.push_back(std::move(result));
  }
}

}  // namespace plastron::config
