// Reads [[support]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <array>
#include <map>
#include <string_view>

namespace plastron::config {

namespace {

using assembly::Direction;
using assembly::Unknown;

// Returns the components of a word such as "u.x". "u" and "r" are the three Cartesian components, "symmetry" is u.n and
// r.n.
std::vector<std::string> components_of(const std::string& word) {
  if (word == "u" || word == "r") return {word + ".x", word + ".y", word + ".z"};
  if (word == "symmetry") return {"u.n", "r.n"};
  return {word};
}

assembly::PrescribedComponent component(const std::string& name) {
  static const std::map<std::string, Direction> directions{
      {"x", Direction::x},       {"y", Direction::y},       {"z", Direction::z},      {"n", Direction::conormal},
      {"t", Direction::tangent}, {"a3", Direction::normal}, {"1", Direction::axis_1}, {"2", Direction::axis_2},
      {"3", Direction::axis_3},  {"d", Direction::given}};
  return {name[0] == 'u' ? Unknown::displacement : Unknown::rotation, directions.at(name.substr(2)), {}};
}

const std::vector<std::string>& fix_words() {
  static const std::vector<std::string> all{"u",   "r",   "u.x", "u.y", "u.z", "u.n",  "u.t",      "u.a3",
                                            "r.x", "r.y", "r.z", "r.n", "r.t", "r.a3", "symmetry", "u.1",
                                            "u.2", "u.3", "u.d", "r.1", "r.2", "r.3",  "r.d"};
  return all;
}

struct Fixed {
  std::string name;
  bool by_symmetry;
};

// Components that earlier words and sections fixed at each place, a boundary in quotes or a point.
using FixedOn = std::map<std::string, std::vector<std::string>>;

bool check_new(Reading& reading, const toml::value& word, const std::string& place, const std::string& name,
               const std::vector<std::string>& before) {
  if (std::ranges::count(before, name) > 0) {
    reading.report(word, fmt::format("{} is fixed twice on {}", name, place));
    return false;
  }
  if (std::ranges::count(before, name[0], [](const std::string& other) { return other[0]; }) < 3) return true;
  reading.report(word,
                 fmt::format("{} on {}: three other components of {} are fixed there already", name, place, name[0]),
                 "at most three components of each of u and r on a boundary");
  return false;
}

std::optional<std::vector<Fixed>> read_fix(Table& support, const std::vector<std::string>& places, FixedOn& fixed_on) {
  const auto words = support.texts("fix");
  if (!words) return {};
  if (words->empty()) support.report("fix", "fix names no component", joined(fix_words()));
  const toml::value list = support.value("fix").value();
  const auto is_new_everywhere = [&](const toml::value& word, const std::string& name) {
    return std::ranges::all_of(places, [&](const std::string& place) {
      return check_new(support.reading(), word, place, name, fixed_on[place]);
    });
  };
  std::vector<Fixed> fixed;
  for (std::size_t i = 0; i < words->size(); ++i)
    for (const std::string& name : components_of((*words)[i])) {
      if (!is_new_everywhere(list.as_array()[i], name)) break;
      for (const std::string& place : places) fixed_on[place].push_back(name);
      fixed.push_back({name, (*words)[i] == "symmetry"});
    }
  return fixed;
}

void read_values(const Table& support, const std::vector<Fixed>& fixed, assembly::Support& result,
                 nlohmann::json& effective) {
  const toml::value table = support.value("values").value();
  Reading& reading = support.reading();
  if (!table.is_table()) return report_kind(reading, Item{table, "values"}, Kind::table);
  std::vector<std::string> allowed;
  for (const Fixed& component : fixed)
    if (!component.by_symmetry) allowed.push_back(component.name);
  for (const auto& [name, value] : named_values(reading, table, {"u", "r"}, "n")) {
    const auto at = std::ranges::find(fixed, name, &Fixed::name);
    if (at == fixed.end() || at->by_symmetry) {
      reading.report(value, fmt::format("values gives {}, which fix does not name", geometry::shortened(name)),
                     joined(allowed), did_you_mean(name, allowed));
    } else if (auto field = read_field(reading, component_item(value, name))) {
      effective[name] = as_json(*field);
      result.components[static_cast<std::size_t>(at - fixed.begin())].value = std::move(*field);
    }
  }
}

/// Places of a support: boundaries, or a point. Nothing if they are wrong.
struct Places {
  std::vector<std::string> boundaries{};
  std::optional<ShellPlace> point{};

  /// Returns their names in messages.
  std::vector<std::string> names() const {
    if (point) return {fmt::format("the point ({:.10g})", fmt::join(*point, ", "))};
    std::vector<std::string> all;
    for (const std::string& boundary : boundaries) all.push_back(fmt::format("\"{}\"", boundary));
    return all;
  }
};

Places read_places(Table& support) {
  if (support.has("boundary") == support.has("point")) {
    support.report_here(support.has("point") ? "[[support]] has both boundary and point"
                                             : "[[support]] has no \"boundary\" and no \"point\"",
                        "one of the two", "write boundary = \"left\", or point = [0, 0]");
    return {};
  }
  if (!support.has("point")) return {.boundaries = read_boundaries(support).value_or(std::vector<std::string>{})};
  const auto point = support.place("point");
  if (point && !check_inside(support, "point", "the point", *point)) return {};
  return {.point = point};
}

/// Checks that a support at a point fixes only Cartesian components of u.
void check_components_at_point(const Table& support) {
  const toml::value given = support.value("fix").value_or(toml::value());
  if (!given.is_array()) return;
  for (const toml::value& word : given.as_array()) {
    if (!word.is_string()) continue;
    const std::string& name = word.as_string().str;
    constexpr std::array in_space{"u", "u.x", "u.y", "u.z", "u.1", "u.2", "u.3", "u.d"};
    if (std::ranges::count(fix_words(), name) == 0 || std::ranges::find(in_space, name) != in_space.end()) continue;
    if (name.starts_with("u."))
      support.reading().report(word, fmt::format("{} is no component at a point: a point has no edge to go by", name),
                               "u, u.x, u.y, u.z");
    else
      support.reading().report(
          word,
          fmt::format("{} cannot be held at a point: rotations of this model have no value there, and "
                      "a couple at a point turns the shell without limit as the mesh is refined",
                      name),
          "u, u.x, u.y, u.z", "fix it on a boundary");
  }
}

/// Reads the directions that words such as u.1 and u.d refer to.
void read_directions(Table& support, const std::vector<Fixed>& fixed, assembly::Support& result) {
  const auto uses = [&](const char* directions) {
    return std::ranges::any_of(fixed, [&](const Fixed& f) {
      return f.name.size() == 3 && std::string_view(directions).find(f.name[2]) != std::string_view::npos;
    });
  };
  if (const auto axes = read_axes(support)) result.axes = *axes;
  if (uses("123") != support.has("axes")) {
    if (support.has("axes"))
      support.report_key("axes", "fix names no component along these axes", "u.1, u.2, u.3, r.1, r.2, r.3");
    else
      support.report("fix", "a component along an axis is fixed, and there are no axes", "",
                     "add for example axes = [[1, 1, 0], [-1, 1, 0]]");
  }
  if (support.has("direction"))
    if (auto direction = support.field_vector("direction")) result.direction = std::move(*direction);
  if (uses("d") != support.has("direction")) {
    if (support.has("direction"))
      support.report_key("direction", "fix names no component along this direction", "u.d, r.d");
    else
      support.report("fix", "a component along a direction is fixed, and there is no direction", "",
                     "add for example direction = [\"cos(x)\", \"sin(x)\", 0]");
  }
}

void read_support(Table& support, FixedOn& fixed_on, problem::Problem& problem) {
  const Places places = read_places(support);
  if (support.has("point")) check_components_at_point(support);
  FixedOn elsewhere;
  const auto names = places.names();
  const std::size_t mistakes = support.reading().mistakes.size();
  const auto fixed =
      read_fix(support, names.empty() ? std::vector<std::string>{"\"\""} : names, names.empty() ? elsewhere : fixed_on);
  if (!fixed) return;
  assembly::Support result;
  if (places.point && is_in_space(*places.point))
    result.point_in_space = places.point->head<3>();
  else if (places.point)
    result.point = places.point->head<2>();
  result.factor = read_factor_name(support, problem);
  if (support.reading().mistakes.size() == mistakes) read_directions(support, *fixed, result);
  for (const Fixed& f : *fixed) {
    result.components.push_back(component(f.name));
    result.symmetry = result.symmetry || f.by_symmetry;
  }
  auto& values = support.effective["values"] = nlohmann::json::object();
  for (const Fixed& f : *fixed)
    if (!f.by_symmetry) values[f.name] = 0.0;
  read_values(support, *fixed, result, values);
  if (places.point) problem.shell.supports.push_back(result);
  for (const std::string& boundary : places.boundaries) {
    problem.shell.supports.push_back(result);
    problem.shell.supports.back().boundary = boundary;
  }
}

}  // namespace

std::optional<std::vector<std::string>> read_boundaries(Table& table, const std::string& name) {
  return table.name_list(name, "boundary", table.reading().boundaries());
}

std::vector<Section> support_sections() {
  return {
      {"support",
       "[[support]]",
       "Prescribed components of the displacement u and the rotation r on boundaries, or of u at a point. Three "
       "points that fix three, two and one component prevent the six rigid motions of a shell whose loads are in "
       "equilibrium. Any other force at a point is singular in this model and causes a warning.",
       {key("name", Kind::name, {}, "a name for step.factors, which then multiply the values"),
        key("boundary", Kind::name_or_names, {},
            "one or several boundaries of the domain; give either boundary or point"),
        key("point", Kind::place, {},
            "a node of the coarsest mesh that finer meshes keep: a corner of a cell; if the degree is even, also "
            "the middle of a side or of a quadrilateral. Only u.x, u.y, u.z can be fixed there"),
        key("fix", Kind::names, {.required = true, .words = fix_words(), .example = "[\"u\", \"r\"]"},
            "the fixed components. n is tangent to the shell and normal to the edge, outward; t runs along the "
            "edge; a3 is normal to the shell. u and r stand for all three components, symmetry stands for u.n and "
            "r.n. 1, 2, 3 are the axes, d is the direction. Any component of r also fixes r.a3"),
        axes_key("u.1, u.2, u.3 and of r.1, r.2, r.3"),
        key("direction", Kind::field_vector, {},
            "the direction of u.d and r.d, three numbers or expressions, of any length but 0: a roller on a slope is "
            "fix = [\"u.d\"] with the normal of the slope"),
        key("values", Kind::free_table, {.unit = "m, rad", .fallback = "{}"},
            "values of fixed components, each a number or an expression of x, y: { u.z = -0.01 } or { u = [0, 0, "
            "\"-0.01*x\"] }; 0 if not given")}}};
}

void read_supports(Table& root, problem::Problem& problem) {
  FixedOn fixed_on;
  root.in_tables("support", [&](Table& support) { read_support(support, fixed_on, problem); });
}

}  // namespace plastron::config
