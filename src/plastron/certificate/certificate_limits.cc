#include <plastron/certificate/certificate_limits.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::certificate {

namespace {

/// Six digits: a thousand times smaller than a good mesh's error, a thousand times larger than a good solution's
/// rounding.
constexpr double algebraic = 1e-6;
/// Nodal forces and energies. Rounding disturbs them in thin shells: at e/L = 1e-4 it reaches about 1e-5 on fine
/// meshes, while results keep four digits. At e/L = 1e-6, near the limit of double precision, it reaches about 1e-3.
constexpr double of_thin_shells = 1e-4;
/// Pressures of the wrong sign below this limit do not change the fourth digit of a resultant.
constexpr double of_largest_pressure = 1e-4;
/// Largest accepted error of a balance that holds only in the limit of refinement.
constexpr double of_the_mesh = 0.05;
/// Part of the thickness. Where no node touches an obstacle, a greater depth is contact missed by the nodes.
constexpr double missed_depth = 1e-2;
/// The same as a part of the largest displacement, and what is rounding.
constexpr double missed_part = 0.05, rounding_depth = 1e-8;
/// Part of the thickness, half the way to the mid-surface. Where nodes touch an obstacle, a greater depth between
/// them means that the obstacle passes through the shell.
constexpr double passing_depth = 0.25;
/// Part of an obstacle's reaction.
constexpr double sideways_part = 1e-2;

const char* missed_reason(const solution::ObstacleContact& obstacle) {
  return obstacle.nodes == 0 ? "a hundredth of the thickness, or a twentieth of the largest displacement, where no "
                               "node touches the obstacle: deeper, the nodes "
                               "have missed the contact; refine the mesh there, ask for an accuracy in place of the "
                               "mesh, or allow it more unknowns"
                             : "a quarter of the thickness between nodes: deeper, the obstacle passes through the "
                               "shell; refine the mesh there, ask for an accuracy in place of the mesh, or allow it "
                               "more unknowns";
}

std::string place_of(const solution::ObstacleContact& obstacle) {
  return fmt::format("{}{} at {}", obstacle.name.empty() ? "the obstacle" : "the obstacle ",
                     obstacle.name.empty() ? "" : fmt::format("\"{}\"", obstacle.name), obstacle.least_gap_place);
}

/// Adds the row of the obstacle that exceeds its limit most.
void add_gap_between(const solution::Summary& s, double admissible, std::vector<CertificateLimit>& limits) {
  const auto allowed = [&](const solution::ObstacleContact& obstacle) {
    return s.is_admissible_wanted ? admissible : least_gap_allowed(s, obstacle);
  };
  const solution::ObstacleContact* worst = nullptr;
  for (const solution::ObstacleContact& obstacle : s.obstacles)
    if (std::isfinite(obstacle.least_gap) &&
        (!worst || obstacle.least_gap - allowed(obstacle) < worst->least_gap - allowed(*worst)))
      worst = &obstacle;
  if (!worst) return;
  const char* reason =
      s.is_admissible_wanted
          ? "admissible = true wants the shell out of the obstacles between its nodes, too; where no lift of "
            "bounds brings that, supports hold it there, obstacles leave no room or the mesh is too coarse"
          : missed_reason(*worst);
  limits.push_back({"min_gap_between", "m", worst->least_gap, allowed(*worst), true, reason, place_of(*worst)});
}

void add_pushed_sideways(const solution::Summary& s, std::vector<CertificateLimit>& limits) {
  const auto worst = std::ranges::max_element(s.obstacles, {}, &solution::ObstacleContact::sideways_part);
  if (worst == s.obstacles.end() || worst->sideways_part == 0) return;
  limits.push_back({"pushed_sideways", "1", worst->sideways_part, sideways_part, false,
                    "an obstacle presses on the shell's face: where more of the shell than its thickness lies in an "
                    "obstacle, the surface nearest "
                    "to a point need not be the one that the shell meets; let the obstacle come in by [[step]]s",
                    fmt::format("the obstacle{}", worst->name.empty() ? "" : fmt::format(" \"{}\"", worst->name))});
}

void add_contact_limits(const Verdict& v, double length, std::vector<CertificateLimit>& limits) {
  const solution::Summary& s = v.summary;
  const Certificate& c = v.certificate;
  if (std::isfinite(c.min_gap_nodes))
    limits.push_back({"min_gap_nodes", "m", c.min_gap_nodes, -algebraic * length, true,
                      "a millionth of the thickness or of the largest displacement, whichever is more"});
  add_gap_between(s, -algebraic * length, limits);
  add_pushed_sideways(s, limits);
  if (s.touching_nodes == 0) return;
  limits.push_back({"min_pressure", "Pa", c.min_pressure, -of_largest_pressure * s.max_pressure, true,
                    "an obstacle does not pull: a ten-thousandth of the largest pressure"});
  limits.push_back(
      {"complementarity", "Pa m", c.complementarity, algebraic * s.max_pressure * length, false,
       "pressure acts where the gap is closed: a millionth of largest pressure times thickness or displacement"});
}

}  // namespace

std::string CertificateLimit::text() const {
  const std::string_view space = unit == "1" ? "" : " ";
  const std::string_view shown = unit == "1" ? "" : unit;
  const std::string where = place.empty() ? "" : fmt::format(" ({})", place);
  return fmt::format("{} is {:.2g}{}{}{}, its limit {:.2g}{}{}", row, value, space, shown, where, limit, space, shown);
}

double least_gap_allowed(const solution::Summary& summary, const solution::ObstacleContact& obstacle) {
  if (obstacle.nodes > 0) return -passing_depth * summary.least_thickness;
  // However thin the depth is, the obstacle would move the shell by it.
  return -std::clamp(missed_part * summary.max_displacement, rounding_depth * summary.least_thickness,
                     missed_depth * summary.least_thickness);
}

std::vector<CertificateLimit> certificate_limits(const Verdict& v, element::Formulation formulation) {
  const Certificate& c = v.certificate;
  std::vector<CertificateLimit> limits{
      {"stationarity", "1", c.stationarity, of_thin_shells, false, "forces balance at every node to four digits"}};
  const double length = std::max(v.summary.least_thickness, v.summary.max_displacement);
  limits.push_back({"support_error", "m", c.support_error, algebraic * length, false,
                    "supports hold: a millionth of the thickness or of the largest displacement, whichever is more"});
  add_contact_limits(v, length, limits);
  const bool is_covariant = formulation == element::Formulation::classical;
  limits.push_back({"force_balance", "1", c.force_balance, is_covariant ? of_the_mesh : algebraic, false,
                    is_covariant ? "covariant components hold translations as well as the mesh does"
                                 : "translations are in the space: the sum of all forces is algebra"});
  limits.push_back({"moment_balance", "1", c.moment_balance, of_the_mesh, false,
                    "rotations are interpolated on curved shells: the sum of moments is as good as the mesh"});
  if (std::isnan(c.energy_derivative))
    limits.push_back(
        {"energy_identity", "1", c.energy_identity, of_thin_shells, false, "the work done is stored, to four digits"});
  else
    limits.push_back({"energy_derivative", "1", c.energy_derivative, of_thin_shells, false,
                      "the forces of the stresses are the derivative of the energy, to four digits"});
  return limits;
}

}  // namespace plastron::certificate
