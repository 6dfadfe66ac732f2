// Checks the gap of the undeformed shell (M16): K must not be empty.
#include <plastron/examination/checks.hpp>
#include <plastron/meshing/sizes.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace plastron::examination {

namespace {

/// Returns the places of the supports that act at a node: 'the boundary "left"', "the point (0, 0)".
std::string supports_of(std::size_t node, const Examined& examined, const ExaminedNodes& nodes) {
  std::vector<std::string> names;
  for (const assembly::Support& support : examined.problem.shell.supports) {
    const auto rows = assembly::node_supports(*examined.space, *examined.surface, nodes.points, {support});
    const std::string name = support.point
                                 ? fmt::format("the point ({:.6g}, {:.6g})", (*support.point)[0], (*support.point)[1])
                                 : fmt::format("the boundary \"{}\"", support.boundary);
    if ((!rows[node].displacement.empty() || !rows[node].rotation.empty()) &&
        std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Warns if all nodes of a given mesh may miss an obstacle that is smaller than their distance. With an accuracy, the
/// mesh is refined there.
void check_roundness(Examined& examined, const assembly::NodalPoint& nearest, std::size_t obstacle) {
  const problem::Problem& problem = examined.problem;
  if (problem.accuracy || problem.shell.obstacles.all[obstacle].is_plane()) return;
  const double radius =
      obstacle::face_gap(problem.shell.obstacles.all[obstacle], {nearest.phi, nearest.a3, nearest.thickness}).roundness;
  double longest = 0;
  for (const meshing::CellSize& cell : meshing::cell_sizes(problem)) longest = std::max(longest, cell.longest_side);
  const double spacing = longest / problem.discretisation.degree;
  if (!(radius > 0) || 2 * radius >= spacing) return;
  examined.add(
      Severity::warning,
      "nodes of the finest mesh are up to {:.3g} m apart, and {} has a rounding of radius {:.3g} m where it is "
      "nearest: all nodes may miss it; refine the mesh, or leave out [mesh] and ask for an accuracy",
      spacing, obstacle_text(problem, obstacle), radius);
}

}  // namespace

namespace {

/// Checks that each stiffness of a bed is within sixteen digits of that of the shell through its thickness. Returns whether it is.
bool check_bed(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle) {
  constexpr double stiffest = 1e9, softest = 1e-13;
  if (!examined.problem.shell.obstacles.all[obstacle].has_bed()) return true;
  const auto [least, most] = examined.problem.shell.obstacles.all[obstacle].bed.stiffnesses();
  const assembly::NodalPoint& point = nodes.points.front();
  const double own = point.young / point.thickness;
  if (least > softest * own && most < stiffest * own) return true;
  const double bed = most < stiffest * own ? least : most;
  examined.add(Severity::error, "the bed of {} has {:.3g} of the stiffness E/e of the shell through its thickness: {}",
               obstacle_text(examined.problem, obstacle), bed / own,
               bed < own ? "it carries nothing that double precision shows; leave the obstacle out"
                         : "it is rigid in double precision; leave bed out");
  return false;
}

}  // namespace

void check_gap(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle) {
  const auto& [points, coordinates] = nodes;
  const auto& gaps = coordinates.gaps[obstacle];
  const std::string which = obstacle_text(examined.problem, obstacle);
  if (!check_bed(examined, nodes, obstacle)) return;
  const auto initial = [](const obstacle::Gap& gap) { return gap.initial; };
  const auto [least, most] = std::ranges::minmax_element(gaps, {}, initial);
  const double rounding = 1e-9 * (examined.size + std::abs(least->initial));
  const char* question =
      most->initial < -rounding
          ? "; the whole shell lies inside of it: is a normal reversed, the obstacle's or the chart's?"
          : "";
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const assembly::ContactRow& row = coordinates.rows_of(i)[obstacle]; coordinates.is_fixed_inside(row, points[i]))
      return examined.add(Severity::error,
                          "the support of {} holds the shell inside of {} at {}: its face "
                          "lies {:.4g} m deep there and cannot move; lower the obstacle or move the support{}",
                          supports_of(i, examined, nodes), which, examined.place(points[i].x), -row.bound_gap,
                          question);
  const assembly::NodalPoint& nearest = points[static_cast<std::size_t>(least - gaps.begin())];
  check_roundness(examined, nearest, obstacle);
  const auto& at = nearest.x;
  const bool reaches_in = least->initial < -rounding;
  examined.add(reaches_in ? Severity::warning : Severity::note, "initial gap{}: {:.4g} m (at {}) to {:.4g} m{}{}",
               examined.problem.shell.obstacles.all.size() == 1 ? "" : " to " + which, least->initial,
               examined.place(at), most->initial,
               reaches_in ? "; the undeformed shell reaches into the obstacle and will be pushed out" : "", question);
}

}  // namespace plastron::examination
