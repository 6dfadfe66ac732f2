#include <plastron/computation/doubts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::computation {

namespace {

/// The strains leave out squares of the rotation: half of 0.3^2 is five per cent of the length of a line.
constexpr double largest_rotation = 0.3;
/// A displacement of this part of the shell's size turns it as far somewhere, rigid motions apart.
constexpr double largest_displacement = 0.3;
/// Penetration between nodes that is worth a word, as a part of the thickness.
constexpr double notable_depth = 0.05;
/// Tolerances may be so much looser than asked for before it is said.
constexpr double notable_loosening = 1e3;

std::string linear_model_text(const char* what, const certificate::Summary& s) {
  return fmt::format(
      "the linear model is left: {}; the largest rotation is {:.3g} rad, the largest displacement {:.3g} m or {:.3g} "
      "thicknesses, and strains linear in them are wrong beyond about {:g} rad; reduce the loads or take the result as "
      "the "
      "linear model's only",
      what, s.max_rotation, s.max_displacement, s.max_relative_displacement, largest_rotation);
}

std::string penetration_text(double depth, double part) {
  return fmt::format(
      "between its nodes the shell enters the obstacle by {:.2g} m, {:.0f} % of the thickness: no bound holds it "
      "there; refine the mesh, raise the degree or set admissible = true in [contact]",
      depth, 100 * part);
}

/// One for each obstacle that the shell touches along lines inside.
std::vector<std::string> line_contact_warnings(const certificate::Summary& summary) {
  constexpr double notable = 0.01;  // of the obstacle's reaction
  std::vector<std::string> warnings;
  for (const certificate::ObstacleContact& obstacle : summary.obstacles) {
    double force = 0, per_length = 0;
    for (const certificate::ContactZone& zone : obstacle.zones) {
      if (!zone.is_line()) continue;
      force += zone.reaction.force.norm();
      per_length = std::max(per_length, zone.line_reaction());
    }
    if (!(force > notable * obstacle.reaction.force.norm())) continue;
    warnings.push_back(fmt::format(
        "the shell touches {} along lines or in points that are narrower than the distance of nodes: they carry "
        "{:.4g} N{}; the pressure (eta) at their nodes depends on the mesh",
        obstacle.name.empty() ? "the obstacle" : "\"" + obstacle.name + "\"", force,
        per_length > 0 ? fmt::format(", up to {:.4g} N/m", per_length) : ""));
  }
  return warnings;
}

}  // namespace

std::vector<std::string> sideways_warnings(const certificate::Summary& summary) {
  std::vector<std::string> warnings;
  for (const certificate::ObstacleContact& obstacle : summary.obstacles) {
    const std::int64_t count = obstacle.sideways_nodes;
    if (count == 0) continue;
    warnings.push_back(
        fmt::format("{} {} deep inside of {} at the start {} pushed out of it sideways, along the shell: the surface "
                    "nearest to a point inside of a body need not be the one that the shell meets; let the obstacle "
                    "come in by [[step]]s, round its edges or refine the mesh",
                    count, count == 1 ? "node" : "nodes",
                    obstacle.name.empty() ? "the obstacle" : "\"" + obstacle.name + "\"", count == 1 ? "was" : "were"));
  }
  return warnings;
}

std::vector<std::string> linear_model_warnings(const certificate::Summary& summary) {
  if (summary.max_rotation > largest_rotation) return {linear_model_text("rotations are not small", summary)};
  if (summary.max_displacement > largest_displacement * summary.size)
    return {linear_model_text("displacements are not small beside the shell", summary)};
  return {};
}

std::vector<std::string> body_warnings(const certificate::Summary& summary) {
  std::vector<std::string> warnings;
  for (const certificate::BodyReaction& body : summary.body_reactions)
    if (-body.least_gap > notable_depth * summary.least_thickness)
      warnings.push_back(fmt::format(
          "the rigid body \"{}\" takes the shell {:.2g} m into an obstacle: nothing holds the nodes of a body "
          "out of obstacles; fix the body where the obstacle would, or let it carry an edge that stays out",
          body.name, -body.least_gap));
  return warnings;
}

void judge_certificate(Result& result) {
  result.limits = certificate::certificate_limits({.summary = result.summary, .certificate = result.certificate},
                                                  result.formulation);
  result.missed_limits.clear();
  for (const auto& limit : result.limits)
    if (!limit.holds())
      result.missed_limits +=
          fmt::format("{}{} ({})", result.missed_limits.empty() ? "" : "; ", limit.text(), limit.reason);
  if (result.status == contact::Status::solved && !result.missed_limits.empty())
    result.status = contact::Status::inaccurate;
}

std::vector<std::string> contact_warnings(const Result& result, const contact::Settings& asked) {
  std::vector<std::string> warnings;
  const certificate::Summary& s = result.summary;
  const double depth = -result.certificate.min_gap_between, part = depth / s.least_thickness;
  if (std::isfinite(depth) && s.touching_nodes > 0 && part > notable_depth)
    warnings.push_back(penetration_text(depth, part));
  if (s.edge.is_line())
    warnings.push_back(
        fmt::format("the shell stands on its edge: {:.4g} N of the reaction are concentrated on it, up to {:.4g} N/m; "
                    "the pressure (eta) at nodes of that edge depends on the mesh",
                    s.edge.force, s.edge.max_per_length));
  else
    for (std::string& text : line_contact_warnings(s)) warnings.push_back(std::move(text));
  if (result.levels.empty()) return warnings;
  const contact::Tolerances& used = result.levels.back().tolerances;
  if (used.gap > notable_loosening * asked.gap_tolerance ||
      used.multiplier > notable_loosening * asked.multiplier_tolerance)
    warnings.push_back(
        fmt::format("rounding has loosened the tolerances of contact: gaps are closed to {:.1g} of the largest "
                    "displacement at contact "
                    "nodes, signs of reactions hold to {:.1g} of the largest (asked: {:.1g} and {:.1g})",
                    used.gap, used.multiplier, asked.gap_tolerance, asked.multiplier_tolerance));
  return warnings;
}

}  // namespace plastron::computation
