// The gap of the undeformed shell (M16): K must not be empty.
#include <plastron/study/checks.hpp>
#include <plastron/study/gap.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace plastron::study {

namespace {

/// The boundaries whose supports act at a node, each in quotes.
std::string supports_of(std::size_t node, const Examined& examined, const ExaminedNodes& nodes) {
  std::vector<std::string> names;
  for (const assembly::Support& support : examined.problem.supports) {
    const auto rows = assembly::node_supports(*examined.space, *examined.surface, nodes.points, {support});
    const std::string name = fmt::format("\"{}\"", support.boundary);
    if ((!rows[node].displacement.empty() || !rows[node].rotation.empty()) &&
        std::ranges::find(names, name) == names.end())
      names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void check_gap(Examined& examined, const ExaminedNodes& nodes) {
  const auto& [points, coordinates] = nodes;
  double least = INFINITY, most = -INFINITY;
  std::size_t at = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double g = coordinates.gaps[i].initial;
    if (g < least) {
      least = g;
      at = i;
    }
    most = std::max(most, g);
    if (is_held_inside(coordinates, points[i], i))
      return examined.add(
          Severity::error,
          "the support of the boundary {} holds the shell inside of the obstacle at x = {:.6g}, y = {:.6g}: its face "
          "lies {:.4g} m deep there and cannot move; lower the obstacle or move the support",
          supports_of(i, examined, nodes), points[i].x[0], points[i].x[1], -coordinates.bound_gap[i]);
  }
  examined.add(least < 0 ? Severity::warning : Severity::note,
               "initial gap: {:.4g} m (at x = {:.4g}, y = {:.4g}) to {:.4g} m{}", least, points[at].x[0],
               points[at].x[1], most,
               least < 0 ? "; the undeformed shell reaches into the obstacle and will be pushed out" : "");
}

}  // namespace plastron::study
