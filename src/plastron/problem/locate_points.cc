#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/problem/problem.hpp>

#include <algorithm>

namespace plastron::problem {

void locate_points(Problem& problem) {
  const bool has_any =
      std::ranges::any_of(problem.probes, [](const Probe& probe) { return probe.in_space.has_value(); }) ||
      std::ranges::any_of(problem.lines, [](const Line& line) { return !line.in_space.empty(); }) ||
      std::ranges::any_of(problem.shell.supports,
                          [](const auto& support) { return support.point_in_space.has_value(); }) ||
      std::ranges::any_of(problem.shell.foundations,
                          [](const auto& foundation) { return foundation.point_in_space.has_value(); });
  if (!has_any) return;
  const fem::Surface surface(
      std::make_shared<const mesh::CoarseMesh>(domain::coarse_mesh(problem.domain, problem.discretisation.cells)),
      problem.charts);
  const auto point = [&](const Eigen::Vector3d& place) { return fem::nearest_point(surface, place).point; };
  for (Probe& probe : problem.probes)
    if (probe.in_space) probe.at = point(*probe.in_space);
  for (Line& line : problem.lines) {
    if (line.in_space.empty()) continue;
    line.points.clear();
    for (const Eigen::Vector3d& place : line.in_space) line.points.push_back(point(place));
  }
  for (energy::Foundation& spring : problem.shell.foundations)
    if (spring.point_in_space) spring.point = point(*spring.point_in_space);
  for (assembly::Support& support : problem.shell.supports)
    if (support.point_in_space)
      support.point = fem::nearest_kept_node(surface, problem.discretisation.degree, *support.point_in_space).point;
}

}  // namespace plastron::problem
