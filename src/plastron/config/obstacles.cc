// Reads [[obstacle]].
#include <plastron/config/sections.hpp>
#include <plastron/problem/both_faces.hpp>

namespace plastron::config {

std::vector<std::size_t> obstacles_named(const problem::Problem& problem, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < problem.shell.obstacles.all.size(); ++k) {
    const std::string& its = problem.shell.obstacles.all[k].name;
    if (its == name || its == name + problem::of_lower_face || its == name + problem::of_upper_face) found.push_back(k);
  }
  return found;
}

namespace {

/// Returns the given name, otherwise "obstacle-1", "obstacle-2", ... by the obstacle's place.
std::string read_obstacle_name(Table& table, const problem::Problem& problem, std::size_t place) {
  std::string name = fmt::format("obstacle-{}", place);
  const bool is_given = table.has("name");
  if (is_given) name = table.text("name").value_or(name);
  table.effective["name"] = name;
  if (name.empty()) table.report("name", "an obstacle's name is empty", "", "leave the key out or give a name");
  if (!obstacles_named(problem, name).empty()) {
    const std::string what = fmt::format("two obstacles are named \"{}\"", name);
    if (is_given)
      table.report("name", what, "", "choose another name");
    else
      table.report_here(what, "", "give this one a name, it has none of its own");
  }
  return name;
}

/// Adds one obstacle for each face that it may meet.
void add_faces(obstacle::Obstacle body, const std::string& face, problem::Problem& problem) {
  using obstacle::Face;
  if (face == "both") {
    for (obstacle::Obstacle& one : problem::for_both_faces(body)) problem.shell.obstacles.all.push_back(std::move(one));
    return;
  }
  body.face = face == "lower" ? Face::lower : face == "upper" ? Face::upper : Face::nearer;
  problem.shell.obstacles.all.push_back(std::move(body));
}

/// Whether a list of a bed's table rises from 0; reports where it does not.
bool rises_from_zero(const Table& table, const std::string& name, const std::vector<double>& values) {
  const auto report = [&](const std::string& what, const std::string& allowed) {
    table.report(name, what, allowed, "for example bed = { closure = [0, 0.001, 0.003], pressure = [0, 2e4, 1e5] }");
    return false;
  };
  if (values.size() < 2)
    return report(fmt::format("{} has fewer than two entries", name), "at least two, the first one 0");
  if (values[0] != 0) return report(fmt::format("{} begins with {}", name, values[0]), "0 first: an open bed is free");
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      return report(
          fmt::format("entry {} of {} is {}, and the one before it is {}", i + 1, name, values[i], values[i - 1]),
          "numbers that rise");
  return true;
}

/// Reads bed = stiffness or { closure = [...], pressure = [...] }.
std::optional<obstacle::Bed> read_bed(Table& obstacle, const std::string& name) {
  if (!obstacle.has(name)) return {};
  if (!obstacle.value(name)->is_table()) {
    const auto stiffness = obstacle.number(name);
    return stiffness ? std::optional(obstacle::Bed(*stiffness)) : std::nullopt;
  }
  std::optional<obstacle::Bed> bed;
  obstacle.in_table(name, [&](Table& table) {
    const auto closure = table.numbers("closure"), pressure = table.numbers("pressure");
    if (!closure || !pressure || !rises_from_zero(table, "closure", *closure) ||
        !rises_from_zero(table, "pressure", *pressure))
      return;
    if (closure->size() != pressure->size())
      return table.report("pressure",
                          fmt::format("pressure has {} entries, and closure has {}", pressure->size(), closure->size()),
                          "a pressure for each closure");
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < closure->size(); ++i) points.emplace_back((*closure)[i], (*pressure)[i]);
    bed.emplace(points);
  });
  return bed;
}

Section bed_section() {
  return {
      "obstacle.bed",
      "bed",
      "The pressure of a bed by its closure, the distance by which its surface gives: straight between the points, and "
      "beyond the last one as before it. Both numbers rise from 0, so the bed may stiffen or soften.",
      {key("closure", Kind::numbers,
           {.unit = "m", .required = true, .range = {.low = 0}, .example = "[0, 0.001, 0.003]"},
           "distances by which the surface gives, at least two"),
       key("pressure", Kind::numbers, {.unit = "Pa", .required = true, .range = {.low = 0}, .example = "[0, 2e4, 1e5]"},
           "the pressure at each of them")}};
}

Section obstacle_section() {
  const auto table = [](const char* name, const char* meaning) { return key(name, Kind::table, {}, meaning); };
  return {
      "obstacle",
      "[[obstacle]]",
      "A rigid body that the shell cannot enter. It has exactly one of the shapes half_space to surface. There may "
      "be several obstacles, for example floor and ceiling.",
      {key("name", Kind::name, {},
           "a name that no other obstacle has, for results and messages; obstacle-1, obstacle-2, ... if not given"),
       table("half_space", "all points on one side of a plane"), table("ball", "a ball, or a bowl"),
       table("cylinder", "a roller, a bar or a tube"), table("box", "a box"), table("torus", "a ring"),
       table("cone", "a cone"),
       key("height_field", Kind::table, {.shorthand = Kind::space_formula},
           "all points below z = h(X, Y); also written height_field = \"0.02*cos(X)\". rotate and translate move "
           "its frame"),
       key("distance", Kind::space_formula, {},
           "all points where the expression is not positive. The expression need not be a distance: the distance "
           "to its zero set is computed. It must change its sign there. Its gradient must not be zero there, nor "
           "where the shell is. A kink away from the zero set and the shell does no harm, such as that of abs(Z) - "
           "0.1 at Z = 0"),
       key("surface", Kind::text, {},
           "a file .stl, .obj or .ply of at most 256 MB and two million triangles; its path is relative to the "
           "case file. It holds the closed surface of a body, with normals outward and without self-intersections. "
           "Corners at open sides are joined if their distance is less than a millionth of the surface's diagonal "
           "and a hundredth of its median side"),
       table("rotate", "rotation of the shape, before translate"),
       key("translate", &obstacle::Motion::translation, {.unit = "m", .fallback = "[0, 0, 0]"},
           "translation of the shape, after rotate"),
       key("force", &obstacle::Obstacle::force, {.unit = "N", .fallback = "[0, 0, 0]"},
           "force that presses the obstacle. The obstacle moves along the force as far as the shell lets it; it "
           "does not move across the force or rotate. [0, 0, 0]: the obstacle is fixed"),
       key("bed", &obstacle::Obstacle::bed, read_bed,
           {.kind = Kind::number, .unit = "N/m^3", .range = Range::positive(), .shorthand = Kind::table},
           "stiffness of an elastic surface, such as a rubber mat or soil: it gives by pressure over bed, and does not "
           "pull. A table has pressures by closure instead, so that it may stiffen or soften: "
           "{ closure = [0, 0.001, 0.003], pressure = [0, 2e4, 1e5] }. One obstacle may have a bed. Without it the "
           "obstacle is rigid"),
       key("face", Kind::word, {.fallback = "\"auto\"", .words = {"auto", "lower", "upper", "both"}},
           "the face of the shell that may touch. lower: at -e/2 along a3; upper: at +e/2; auto: at each point the "
           "face that looks at the obstacle; both: two obstacles, one for each face, with separate results. Where "
           "the shell stands on an edge, auto is both, unless a force presses the obstacle")},
      {"half_space", "ball", "cylinder", "box", "torus", "cone", "height_field", "distance", "surface"}};
}

/// Checks that a bed agrees with what was read before.
void check_bed(const Table& table, const std::string& face, const problem::Problem& problem) {
  if (face == "both")
    table.report_key("bed", "an obstacle that both faces may touch cannot have a bed", "",
                     "say which face touches it: lower, upper or auto");
  if (const auto other = problem.shell.obstacles.on_bed())
    table.report_key("bed",
                     fmt::format("the obstacle \"{}\" has a bed already", problem.shell.obstacles.all[*other].name),
                     "a bed on one obstacle", "make one of them rigid; a [[foundation]] resists in both directions");
  if (element::is_relaxed(problem.shell.tangency.formulation))
    table.report_key(
        "bed", fmt::format("the {} formulation has no beds", element::to_string(problem.shell.tangency.formulation)),
        "", "write formulation = \"tangent\"");
}

}  // namespace

std::vector<Section> obstacle_sections() {
  std::vector<Section> all{obstacle_section()};
  std::ranges::move(obstacle_shape_sections(), std::back_inserter(all));
  all.push_back(bed_section());
  all.push_back(rotate_section("obstacle.rotate"));
  return all;
}

void read_obstacles(Table& root, problem::Problem& problem) {
  std::size_t place = 0;
  root.in_tables("obstacle", [&](Table& table) {
    obstacle::Obstacle result;
    result.name = read_obstacle_name(table, problem, ++place);
    if (auto shape = read_shape(table)) result.shape = std::move(*shape);
    result.placement = read_motion(table).value_or(obstacle::Motion{}).after(1);
    table.fill(result);
    const std::string face = table.text("face").value_or("auto");
    if (face == "both" && result.is_pressed())
      table.report("force", "an obstacle that both faces may touch cannot be pressed by a force", "",
                   "say which face touches it: lower, upper or auto");
    if (result.has_bed()) check_bed(table, face, problem);
    add_faces(std::move(result), face, problem);
  });
}

}  // namespace plastron::config
