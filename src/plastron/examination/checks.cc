// The whole examination. Names and chart come first: other checks are meaningless if these are wrong.
#include <plastron/examination/examine.hpp>

#include <plastron/assembly/deformed.hpp>
#include <plastron/energy/load_vector.hpp>
#include <plastron/examination/checks.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plastron::examination {

namespace {

/// Returns a mesh of some thousand sample points, equal on every rank.
std::shared_ptr<const fem::Space> sample_mesh(const problem::Problem& problem) {
  constexpr int enough_cells = 256;
  const problem::Discretisation& d = problem.discretisation;
  const int degree = d.cells == mesh::Shape::triangle ? d.degree : std::clamp(d.degree, 2, 4);
  fem::MeshSequence meshes(meshing::start_mesh(problem).coarse, degree, MPI_COMM_SELF, meshing::joining(problem));
  while (meshes.space()->global_cells < enough_cells) meshes.refine({});
  return meshes.space();
}

/// Runs the checks that need the nodes.
void check_nodes(Examined& examined) {
  try {
    check_symmetry(examined);
    check_directors(examined);
    const ExaminedNodes nodes(
        examined, examined.problem.steps.empty() ? energy::Factors{} : examined.problem.steps.front().factors);
    for (std::size_t k = 0; k < examined.problem.shell.obstacles.all.size(); ++k) {
      check_gap(examined, nodes, k);
      check_face(examined, nodes, k);
      check_sides(examined, nodes, k);
    }
    check_room(examined, nodes);
    check_formulation(examined, nodes);
    check_rigid_motions(examined, nodes);
  } catch (const assembly::SupportError& error) {
    examined.add(Severity::error, "{}", error.what());
  } catch (const energy::LoadError& error) {
    if (!has_errors(examined.findings)) examined.add(Severity::error, "{}", error.what());
  }
}

std::vector<Finding> findings_of(const problem::Problem& problem) {
  Examined examined(problem);
  for (const auto check : {check_names, check_chart}) {
    check(examined);
    if (has_errors(examined.findings)) return examined.findings;
  }
  for (const auto check :
       {check_surface_mesh, check_normals, check_seams, check_finite, check_surfaces, check_materials, check_weight,
        check_locking, check_soft_layers, check_precision, check_start_mesh, check_probes, check_lines})
    check(examined);
  // Otherwise values that are not finite would be reported again with another text.
  if (!has_errors(examined.findings)) check_inside_cells(examined);
  check_nodes(examined);
  return examined.findings;
}

}  // namespace

Examined::Examined(const problem::Problem& a_problem)
    : problem(a_problem),
      space(sample_mesh(a_problem)),
      surface(std::make_shared<const fem::Surface>(space->coarse, a_problem.charts)),
      tables(element::element_tables(space->shape(), space->degree, false)) {}

std::string Examined::place(const Eigen::Vector2d& x) const {
  if (surface->has_directors()) return fem::place_text(*surface, x);
  double extent = 0;
  for (const auto& vertex : space->coarse->vertices) extent = std::max(extent, (vertex - x).norm());
  const auto cleared = [&](double c) { return std::abs(c) < 1e-12 * extent ? 0 : c; };
  return fmt::format("x = {:.6g}, y = {:.6g}", cleared(x[0]), cleared(x[1]));
}

namespace {

/// Returns the supports of the undeformed shell. With finite rotations three components of r prescribe a director.
std::vector<assembly::NodeSupport> supports_of(const Examined& examined,
                                               const std::vector<assembly::NodalPoint>& points,
                                               const energy::Factors& factors) {
  const assembly::ShellDescription& shell = examined.problem.shell;
  auto supports = assembly::node_supports(*examined.space, *examined.surface, points, shell.supports,
                                          {.released = factors.released});
  if (shell.rotations == element::Rotations::small) return supports;
  return assembly::remaining_supports(std::move(supports), points, algebra::Vector(examined.space->layout, 6));
}

}  // namespace

ExaminedNodes::ExaminedNodes(const Examined& examined, const energy::Factors& factors)
    : points(assembly::nodal_geometry(*examined.space, *examined.surface, examined.tables,
                                      examined.problem.shell.sections)),
      coordinates(assembly::nodal_coordinates(examined.space, points, supports_of(examined, points, factors),
                                              examined.problem.shell.obstacles,
                                              examined.problem.shell.tangency.formulation)) {}

std::string obstacle_text(const problem::Problem& problem, std::size_t obstacle) {
  return problem.shell.obstacles.all.size() == 1
             ? "the obstacle"
             : fmt::format("the obstacle \"{}\"", problem.shell.obstacles.all[obstacle].name);
}

std::string vector_text(Eigen::Vector3d v, double size) {
  const double negligible = 5e-4 * std::max(v.norm(), size);
  for (double& c : v)
    if (std::abs(c) < negligible) c = 0;
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", v[0], v[1], v[2]);
}

double degrees_between(double unit_difference) {
  return 2 * std::asin(std::min(1.0, unit_difference / 2)) * 180 / std::numbers::pi;
}

bool has_errors(const std::vector<Finding>& findings) {
  return std::ranges::any_of(findings, [](const Finding& f) { return f.severity == Severity::error; });
}

std::vector<Finding> examine(const problem::Problem& problem) {
  try {
    return findings_of(problem);
  } catch (const mesh::DomainError& error) {
    return {{Severity::error, error.what()}};
  }
}

}  // namespace plastron::examination
