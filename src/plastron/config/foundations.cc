// Reads [[foundation]] and [[spring]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace plastron::config {

namespace {

using energy::Foundation;

constexpr const char* kinds = "normal, tangential, stiffness, shear";

Section foundation_section() {
  return {
      "foundation",
      "[[foundation]]",
      "An elastic foundation under the surface or along a boundary, fixed to the shell: it resists the motion w = u + "
      "z r in both directions (an obstacle resists in one). Its forces are -k w per area of the undeformed "
      "mid-surface, or per length of the boundary. Several foundations add up.",
      {key("name", Kind::name, {}, "a name that no other foundation has; foundation-1, foundation-2, ... if not given"),
       key("region", Kind::name_or_names, {}, "one or several regions; if not given, the whole surface"),
       key("boundary", Kind::name_or_names, {},
           "one or several boundaries along which the foundation is. Not together with region"),
       key("normal", &Foundation::normal, {.unit = "N/m^3, N/m^2", .range = {.low = 0}},
           "stiffness along the normal a3 (Winkler)"),
       key("tangential", &Foundation::tangential, {.unit = "N/m^3, N/m^2", .range = {.low = 0}},
           "stiffness in the tangent plane"),
       key("stiffness", &Foundation::stiffness, &Table::field_vector,
           {.kind = Kind::field_vector, .unit = "N/m^3, N/m^2", .range = {.low = 0}},
           "stiffnesses along the three axes in space; they add to normal and tangential"),
       axes_key("the three components of stiffness"),
       key("shear", &Foundation::shear, {.unit = "N/m", .range = {.low = 0}},
           "stiffness G of a shear layer that resists the gradient of w . a3 (Pasternak); not along a boundary"),
       key("at", Kind::word, {.fallback = "\"middle\"", .words = {"middle", "lower", "upper"}},
           "the place where it acts: the mid-surface, or the face below (z = -e/2) or above it")},
      {},
      "",
      {{"axes", "stiffness"}}};
}

Section spring_section() {
  return {
      "spring",
      "[[spring]]",
      "A spring between a point of the mid-surface, or a rigid body, and a fixed place. At a point it has the forces "
      "-k "
      "u; a force at a point has a singular displacement in this model: it grows with the logarithm of the mesh size, "
      "and so does the spring's. On a body it acts at the reference point, with the forces -k d and the moments -k "
      "theta; with finite rotations theta is the rotation vector, shorter than half a turn.",
      {key("name", Kind::name, {}, "a name that no other spring has; spring-1, spring-2, ... if not given"),
       key("point", Kind::place, {.example = "[0.5, 0.5]"},
           "a point of the domain, or X, Y, Z: the nearest point of the mid-surface"),
       key("body", Kind::name, {.example = "\"end plate\""}, "a rigid body"),
       key("stiffness", &Foundation::stiffness, &Table::field_vector,
           {.kind = Kind::field_vector, .unit = "N/m", .range = {.low = 0}, .example = "[0, 0, 1000]"},
           "stiffnesses along the three axes; on a body numbers"),
       key("rotation", &Foundation::rotation, &Table::field_vector,
           {.kind = Kind::field_vector, .unit = "N m/rad", .range = {.low = 0}},
           "stiffnesses of rotations of a body about the three axes, numbers"),
       axes_key("the three components of stiffness and rotation")},
      {"point", "body"},
      "",
      {{"rotation", "body"}}};
}

std::string read_own_name(Table& table, const std::vector<Foundation>& all, bool is_spring) {
  const char* kind = is_spring ? "spring" : "foundation";
  const auto is_alike = [&](const Foundation& other) { return other.is_spring() == is_spring; };
  std::string name = fmt::format("{}-{}", kind, std::ranges::count_if(all, is_alike) + 1);
  if (table.has("name")) name = table.text("name").value_or(name);
  table.effective["name"] = name;
  if (name.empty())
    table.report("name", fmt::format("the name of a {} is empty", kind), "", "leave the key out or give a name");
  if (std::ranges::any_of(all, [&](const Foundation& other) { return is_alike(other) && other.name == name; }))
    table.report("name", fmt::format("two [[{}]] are named \"{}\"", kind, name), "", "choose another name");
  return name;
}

/// Reads where a foundation acts.
void read_extent(Table& table, const problem::Problem& problem, Foundation& foundation) {
  if (table.has("boundary")) {
    if (table.has("region"))
      table.report_key("region", "a foundation is along a boundary or under a region, not both", "",
                       "write two [[foundation]]");
    if (table.has("shear"))
      table.report_key("shear", "a foundation along a boundary has no shear layer", "normal, tangential, stiffness");
    foundation.boundaries = read_boundaries(table).value_or(std::vector<std::string>{});
  } else if (table.has("region")) {
    foundation.regions =
        table.name_list("region", "region", table.reading().regions()).value_or(std::vector<std::string>{});
  }
  const std::string at = table.text("at").value_or("middle");
  foundation.height = at == "middle" ? 0 : at == "lower" ? -0.5 : 0.5;
  const auto has_even_thickness = [](const energy::CrossSection& section) { return section.thickness.is_constant(); };
  const energy::CrossSections& sections = problem.shell.sections;
  if (table.has("shear") && foundation.height != 0 &&
      !(has_even_thickness(sections.common) &&
        std::ranges::all_of(sections.regions, [&](const auto& own) { return has_even_thickness(own.second); })))
    table.report_key("shear", "a shear layer at a face needs a constant thickness", "", "write at = \"middle\"");
}

/// Reads the body of a spring, on which stiffnesses are numbers.
void read_body(Table& table, const problem::Problem& problem, Foundation& spring) {
  const auto given = table.text("body");
  if (!given) return;
  spring.body = *given;
  std::vector<std::string> names;
  for (const fem::RigidBody& body : problem.rigid_bodies) names.push_back(body.name);
  if (std::ranges::find(names, spring.body) == names.end())
    table.report("body", fmt::format("there is no rigid body \"{}\"", geometry::shortened(spring.body)), joined(names),
                 names.empty() ? "add a [[rigid_body]]" : did_you_mean(spring.body, names));
  for (const auto& [name, values] :
       {std::pair("stiffness", &spring.stiffness), std::pair("rotation", &spring.rotation)})
    if (!std::ranges::all_of(*values, &geometry::Expression::is_constant))
      table.report(name, "the stiffness of a spring on a rigid body depends on the place", "three numbers");
}

}  // namespace

Key axes_key(const std::string& what) {
  return key(
      "axes", Kind::vectors, {},
      fmt::format("the directions of {}: two vectors at a right angle, of any length but 0; the third is normal to "
                  "both. X, Y and Z if not given",
                  what));
}

std::optional<Eigen::Matrix3d> read_axes(Table& table) {
  if (!table.has("axes")) return {};
  const auto given = table.vectors("axes");
  if (!given) return {};
  if (given->size() != 2 || (*given)[0].isZero(0) || (*given)[1].isZero(0)) {
    table.report("axes", "axes are not two vectors other than 0", "two vectors",
                 "write for example axes = [[1, 1, 0], [-1, 1, 0]]");
    return {};
  }
  const Eigen::Vector3d first = (*given)[0].stableNormalized(), second = (*given)[1].stableNormalized();
  constexpr double right_angle = 1e-6;
  if (std::abs(first.dot(second)) > right_angle) {
    table.report("axes", fmt::format("the axes are not at a right angle: the cosine of their angle is {:.3g}",
                                     first.dot(second)));
    return {};
  }
  Eigen::Matrix3d axes;
  axes << first.transpose(), (second - second.dot(first) * first).normalized().transpose(),
      first.cross(second).normalized().transpose();
  return axes;
}

std::vector<Section> foundation_sections() { return {foundation_section(), spring_section()}; }

void read_foundations(Table& root, problem::Problem& problem) {
  std::vector<Foundation>& all = problem.shell.foundations;
  root.in_tables("foundation", [&](Table& table) {
    Foundation foundation{.name = read_own_name(table, all, false)};
    table.fill(foundation);
    if (!table.has("normal") && !table.has("tangential") && !table.has("stiffness") && !table.has("shear"))
      table.report_here("[[foundation]] has no stiffness", kinds, "add for example normal = 1e6");
    if (table.has("axes") && !table.has("stiffness"))
      table.report_key("axes", "the foundation has no stiffness along axes", "",
                       "add stiffness = [..], or remove axes");
    if (const auto axes = read_axes(table)) foundation.axes = *axes;
    read_extent(table, problem, foundation);
    all.push_back(std::move(foundation));
  });
  root.in_tables("spring", [&](Table& table) {
    Foundation spring{.name = read_own_name(table, all, true)};
    table.fill(spring);
    if (const auto axes = read_axes(table)) spring.axes = *axes;
    if (!table.has("stiffness") && !table.has("rotation"))
      table.report_here("[[spring]] has no stiffness", "stiffness; on a body also rotation",
                        "add for example stiffness = [0, 0, 1000]");
    if (table.has("body") == table.has("point"))
      table.report_here(table.has("body") ? "[[spring]] has both point and body" : "[[spring]] has no place",
                        "point, body",
                        table.has("body") ? "write two [[spring]]" : "add for example point = [0.5, 0.5]");
    if (table.has("rotation") && !table.has("body"))
      table.report_key("rotation",
                       "a spring at a point resists no rotation: a rotation at a point has no stiffness in this model",
                       "", "give the point a rigid body, or use [[foundation]] at a face of a small region");
    if (table.has("body")) {
      read_body(table, problem, spring);
      all.push_back(std::move(spring));
      return;
    }
    spring.point = Eigen::Vector2d::Zero();
    if (const auto place = table.place("point")) {
      if (is_in_space(*place))
        spring.point_in_space = place->head<3>();
      else
        spring.point = place->head<2>();
      check_inside(table, "point", "the point", *place);
    }
    all.push_back(std::move(spring));
  });
}

}  // namespace plastron::config
