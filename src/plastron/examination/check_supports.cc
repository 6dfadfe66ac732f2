// Checks the conditions that symmetry and the formulations require of the supports.
#include <plastron/examination/checks.hpp>

#include <plastron/assembly/deformed.hpp>

#include <fmt/ranges.h>

namespace plastron::examination {

void check_symmetry(Examined& examined) {
  constexpr double rounding = 1e-6;  // [rad]
  const auto points =
      assembly::nodal_geometry(*examined.space, *examined.surface, examined.tables, examined.problem.shell.sections);
  for (const assembly::Support& support : examined.problem.shell.supports) {
    if (!support.symmetry) continue;
    const auto rows = assembly::node_supports(*examined.space, *examined.surface, points, {support});
    const Eigen::Vector3d* first = nullptr;
    double largest = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto& [direction, value] : rows[i].displacement) {
        if (!first) first = &direction;
        if (const double turn = (direction - *first).norm(); turn > largest) {
          largest = turn;
          where = i;
        }
      }
    const auto of_mesh = examined.symmetry_accuracy.find(support.boundary);
    const double allowed = of_mesh == examined.symmetry_accuracy.end() ? rounding : of_mesh->second;
    if (largest <= allowed) continue;
    return examined.add(
        Severity::error,
        "the boundary \"{}\" is no symmetry plane: its conormal turns by {:.3g} degrees (at {}); allowed are {:.2g} "
        "degrees{}; symmetry needs a plane edge that the shell meets at a right angle",
        support.boundary, degrees_between(largest), examined.place(points[where].x), degrees_between(allowed),
        of_mesh == examined.symmetry_accuracy.end() ? "" : ", the accuracy of directions in this mesh");
  }
}

void check_directors(Examined& examined) {
  constexpr double most = 0.1, opposite = -0.999;
  if (examined.problem.shell.rotations == element::Rotations::small) return;
  const auto points =
      assembly::nodal_geometry(*examined.space, *examined.surface, examined.tables, examined.problem.shell.sections);
  const auto rows =
      assembly::node_supports(*examined.space, *examined.surface, points, examined.problem.shell.supports);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto director = assembly::prescribed_director(points[i].a3, rows[i]);
    if (!director) continue;
    const Eigen::Vector3d& a3 = points[i].a3;
    if (std::abs(director->norm() / a3.norm() - 1) > most)
      return examined.add(
          Severity::error,
          "supports prescribe all of r at {}: the director a3 + r has the length {:.3g}, and with finite "
          "rotations it must be 1; prescribe r = d - a3 with a unit vector d",
          examined.place(points[i].x), director->norm());
    if (director->normalized().dot(a3.normalized()) < opposite)
      return examined.add(
          Severity::error,
          "supports turn the director at {} by half a turn, and nothing says which way; let a rigid body "
          "turn the edge in steps",
          examined.place(points[i].x));
  }
}

void check_formulation(Examined& examined, const ExaminedNodes& nodes) {
  using element::Formulation;
  const Formulation kind = examined.problem.shell.tangency.formulation;
  const bool has_chart = !examined.surface->has_directors() && examined.surface->coarse().shifts.empty();
  if (kind == Formulation::classical && !has_chart)
    examined.add(Severity::error,
                 "the classical formulation needs a smooth chart, which a mesh in space and the shape of a mode do not "
                 "have; use "
                 "formulation = \"tangent\"");
  if (kind == Formulation::classical && examined.problem.charts.size() > 1)
    examined.add(Severity::error,
                 "the classical formulation needs a smooth chart, and the regions {} have charts of their own, where "
                 "curvature may jump; use formulation = \"tangent\"",
                 fmt::join(examined.space->coarse->regions, ", "));
  if (!element::is_relaxed(kind)) return;
  for (std::size_t i = 0; i < nodes.points.size(); ++i)
    if (nodes.coordinates.is_prescribed(i, assembly::NodalCoordinates::normal_rotation)) return;
  examined.add(
      Severity::error,
      "the {} formulation sees only the gradient of r . a3, and no support fixes a component of r: a constant r . a3 "
      "is left free{}; add \"r.a3\" to the fix of a support, or use formulation = \"tangent\"",
      element::to_string(kind),
      examined.is_developable ? ", and on this developable chart it is part of a seventh motion beside the six rigid "
                                "ones that costs no energy"
                              : "");
}

}  // namespace plastron::examination
