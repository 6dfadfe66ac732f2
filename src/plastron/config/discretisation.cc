// Reads [mesh], [output], [contact] and [solver].
#include <plastron/config/sections.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::config {

namespace {

/// Checks triangles, which have degrees 1 and 2 and no tying. A default of `tying` is changed, a given value is an
/// error.
void check_triangles(Table& mesh, problem::Discretisation& d) {
  if (d.degree > 2)
    mesh.report("degree", fmt::format("degree {} is not available on triangles", d.degree), "1 <= degree <= 2",
                "write cells = \"quadrilateral\" for a higher degree");
  if (d.tying && mesh.has("tying"))
    mesh.report("tying", "the strains of triangles cannot be tied", "tying = false",
                "leave tying out and use degree 2 on a mesh fine enough, or write cells = \"quadrilateral\"");
  d.tying = false;
  mesh.effective["tying"] = false;
}

/// Sets missing values for meshes that follow from estimated errors: an unrefined start mesh with edge layers, of high
/// degree.
void suit_accuracy(Table& mesh, problem::Discretisation& d) {
  const bool is_triangular = d.cells == fem::Shape::triangle;
  if (!mesh.has("refinements")) mesh.effective["refinements"] = d.refinements = 0;
  if (!mesh.has("degree")) mesh.effective["degree"] = d.degree = is_triangular ? 2 : 4;
  if (mesh.has("layers") || is_triangular) return;
  d.layers = problem::Layers::automatic;
  mesh.effective["layers"] = "auto";
}

}  // namespace

void read_mesh(Table& root, problem::Problem& problem) {
  auto mesh = root.table("mesh");
  if (!mesh) return;
  problem::Discretisation& d = problem.discretisation;
  if (mesh->text("cells") == "triangle") d.cells = fem::Shape::triangle;
  d.degree = mesh->integer("degree").value_or(d.degree);
  d.tying = mesh->boolean("tying").value_or(d.tying);
  if (mesh->word_or_false("layers") == "auto") d.layers = problem::Layers::automatic;
  d.refinements = mesh->integer("refinements").value_or(d.refinements);
  if (root.has("accuracy") || !root.has("mesh")) suit_accuracy(*mesh, d);
  if (d.cells == fem::Shape::triangle) check_triangles(*mesh, d);
  root.effective["mesh"] = mesh->effective;
}

namespace {

void read_heights(Table& output, problem::Output& given) {
  constexpr std::size_t most = 50;
  std::vector<double> heights = output.numbers("heights").value_or(std::vector<double>{});
  if (heights.size() > most)
    output.report("heights", fmt::format("{} heights are too many", heights.size()), fmt::format("at most {}", most),
                  "write solid = true for stresses all through the thickness");
  for (const double height : heights)
    if (!(std::abs(height) <= 0.5))
      output.report("heights", fmt::format("the height {:g} lies outside of the shell", height),
                    "-0.5 <= height <= 0.5",
                    "write heights as parts of the thickness: -0.5 is the lower face, 0.5 the upper one");
  for (double& height : heights) height += 0.0;  // no -0 in names of fields
  std::ranges::sort(heights);
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  given.heights = std::move(heights);
}

}  // namespace

bool read_output(Table& root, problem::Problem& problem) {
  auto output = root.table("output");
  if (!output) return true;
  if (const auto axis = output->vector("axis")) {
    if (axis->norm() > 0)
      problem.output.axis = *axis;
    else
      output->report("axis", "this vector has no direction", "a vector other than [0, 0, 0]",
                     "write the direction that t1 shall follow");
  }
  problem.output.smooth = output->text("resultants").value_or("smooth") == "smooth";
  problem.output.moment_point = output->vector("moment_point").value_or(Eigen::Vector3d::Zero());
  read_heights(*output, problem.output);
  problem.output.double_precision = output->text("precision") == "double";
  const bool is_solid = output->boolean("solid").value_or(false);
  const int layers = output->integer("layers").value_or(1);
  problem.output.solid_layers = is_solid ? layers : 0;
  const bool wants_report = output->boolean("report").value_or(true);
  root.effective["output"] = output->effective;
  return wants_report;
}

void read_units(Table& root, problem::UnitNames& units) {
  auto table = root.table("units");
  if (!table) return;
  const auto name = [&](const char* key, std::string& unit, std::initializer_list<std::string_view> taken) {
    const std::string given = table->text(key).value_or(unit);
    const bool is_word = !given.empty() && given.size() <= 8 && std::ranges::all_of(given, [](char c) {
      return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
    });
    if (is_word && std::ranges::find(taken, given) == taken.end())
      unit = given;
    else
      table->report(key, fmt::format("\"{}\" is no name of a unit of {}", given, key),
                    "one to eight letters, and not the name of another unit",
                    std::string("write what the unit is called, such as ") + (unit == "m" ? "\"mm\"" : "\"kN\""));
  };
  name("length", units.length, {"N", "J", "Pa", "rad"});
  name("force", units.force, {"m", "J", "Pa", "rad"});
  root.effective["units"] = table->effective;
}

void read_contact(Table& root, problem::Problem& problem) {
  auto contact = root.table("contact");
  if (!contact) return;
  problem.linearisation.once = contact->boolean("linearised").value_or(false);
  problem.admissible = contact->boolean("admissible").value_or(false);
  root.effective["contact"] = contact->effective;
}

void read_solver(Table& root, problem::Problem& problem) {
  auto solver = root.table("solver");
  if (!solver) return;
  contact::Settings& s = problem.contact;
  s.max_iterations = solver->integer("max_iterations").value_or(s.max_iterations);
  s.linear_tolerance = solver->number("linear_tolerance").value_or(s.linear_tolerance);
  s.gap_tolerance = solver->number("gap_tolerance").value_or(s.gap_tolerance);
  s.multiplier_tolerance = solver->number("multiplier_tolerance").value_or(s.multiplier_tolerance);
  root.effective["solver"] = solver->effective;
}

}  // namespace plastron::config
