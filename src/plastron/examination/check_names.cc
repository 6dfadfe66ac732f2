// Checks names: supports and loads name boundaries and regions, cross-sections name regions, supports and probes name
// points. They must exist.
#include <plastron/examination/checks.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace plastron::examination {

namespace {

void check_point(Examined& examined, const Eigen::Vector2d& x) {
  const auto nodes = mesh::kept_nodes(*examined.space->coarse, examined.problem.discretisation.degree);
  const auto nearest =
      *std::ranges::min_element(nodes, {}, [&](const Eigen::Vector2d& node) { return (node - x).norm(); });
  if ((nearest - x).norm() <= mesh::point_tolerance(*examined.space->coarse)) return;
  examined.add(
      Severity::error,
      "a support holds the point ({:.10g}, {:.10g}), which is no node of the coarsest mesh that finer ones keep; "
      "the nearest one is ({:.10g}, {:.10g}): hold that, or choose cells with a corner at the point",
      x[0], x[1], nearest[0], nearest[1]);
}

}  // namespace

void check_names(Examined& examined) {
  const mesh::CoarseMesh& mesh = *examined.space->coarse;
  const auto check = [&](const std::string& name, const std::vector<std::string>& known, const char* what) {
    if (std::ranges::find(known, name) == known.end())
      examined.add(Severity::error, "{} \"{}\", which the mesh does not have; it has: {}", what, name,
                   known.empty() ? "no names; Physical Surface and Physical Curve of Gmsh give some"
                                 : fmt::format("{}", fmt::join(known, ", ")));
  };
  for (const auto& [name, section] : examined.problem.shell.sections.regions)
    check(name, mesh.regions, "a thickness, material, density or temperature is given for the region");
  const energy::Loads& loads = examined.problem.shell.loads;
  for (const std::string& region : loads.region_names()) check(region, mesh.regions, "a load names the region");
  for (const auto& s : examined.problem.shell.supports) {
    if (s.point)
      check_point(examined, *s.point);
    else
      check(s.boundary, mesh.boundaries, "a support names the boundary");
  }
  for (const std::string& boundary : loads.boundary_names())
    if (std::ranges::find(mesh.fold_boundaries, boundary) != mesh.fold_boundaries.end())
      examined.add(
          Severity::error,
          "a load acts on \"{}\", which has the edges of all sides of the fold: it would count for each of them; "
          "name the curve in the mesh and load that",
          boundary);
  for (const std::string& boundary : loads.boundary_names())
    check(boundary, mesh.boundaries, "a load names the boundary");
  for (const energy::Foundation& foundation : examined.problem.shell.foundations) {
    for (const std::string& region : foundation.regions) check(region, mesh.regions, "a foundation names the region");
    for (const std::string& boundary : foundation.boundaries) {
      check(boundary, mesh.boundaries, "a foundation names the boundary");
      if (std::ranges::find(mesh.fold_boundaries, boundary) != mesh.fold_boundaries.end())
        examined.add(Severity::error,
                     "a foundation is along \"{}\", which has the edges of all sides of the fold: it would count for "
                     "each of them; name the curve in the mesh",
                     boundary);
    }
  }
}

void check_lines(Examined& examined) {
  for (const problem::Line& line : examined.problem.lines) {
    const auto outside = std::ranges::find_if(
        line.points, [&](const Eigen::Vector2d& p) { return !fem::locate(*examined.space->coarse, p); });
    if (outside != line.points.end())
      examined.add(Severity::error, "the line \"{}\" leaves the domain at ({:g}, {:g})", line.name, (*outside)[0],
                   (*outside)[1]);
  }
}

void check_probes(Examined& examined) {
  const mesh::CoarseMesh& mesh = *examined.space->coarse;
  const auto check = [&](const char* what, const std::string& name, const Eigen::Vector2d& at) {
    if (fem::locate(mesh, at)) return;
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& vertex : mesh.vertices) box.extend(vertex);
    examined.add(
        Severity::error,
        "the {} \"{}\" at ({:g}, {:g}) lies outside of the domain; the corners of its cells have x from {:g} to "
        "{:g} and y from {:g} to {:g}",
        what, name, at[0], at[1], box.min()[0], box.max()[0], box.min()[1], box.max()[1]);
  };
  for (const energy::Foundation& spring : examined.problem.shell.foundations)
    if (spring.point) check("spring", spring.name, *spring.point);
  for (const problem::Probe& probe : examined.problem.probes) check("probe", probe.name, probe.at);
}

}  // namespace plastron::examination
