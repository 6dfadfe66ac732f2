#include <plastron/certificate/certificate_limits.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::certificate {

namespace {

/// Six digits: a thousand times better than the mesh of a good computation, a thousand times worse than rounding in one.
constexpr double algebraic = 1e-6;
/// Nodal forces and energies. Rounding spoils them in thin shells: at e/L = 1e-4 it reaches some 1e-5 on fine meshes, with results
/// that hold four digits; at 1e-6, which double precision hardly holds, some 1e-3.
constexpr double of_thin_shells = 1e-4;
/// Pressures of the wrong sign up to here change no resultant in its fourth digit.
constexpr double of_largest_pressure = 1e-4;
/// What a mesh may miss of a balance that only its refinement brings about.
constexpr double of_the_mesh = 0.05;
/// Where nothing touches, a depth beyond this part of the thickness is contact that the nodes have missed.
constexpr double missed_depth = 1e-2;

void add_contact_limits(const Verdict& v, double length, std::vector<CertificateLimit>& limits) {
  const Summary& s = v.summary;
  const Certificate& c = v.certificate;
  if (std::isfinite(c.min_gap_nodes))
    limits.push_back({"min_gap_nodes", "m", c.min_gap_nodes, -algebraic * length, true,
                      "a millionth of the thickness or of the largest displacement, whichever is more"});
  if (s.is_admissible_wanted && std::isfinite(c.min_gap_between))
    limits.push_back({"min_gap_between", "m", c.min_gap_between, -algebraic * length, true,
                      "admissible = true wants the shell out of the obstacles between its nodes, too; where no lift of "
                      "bounds brings that, supports hold it there, obstacles leave no room or the mesh is too coarse"});
  if (s.touching_nodes == 0) {
    if (!s.is_admissible_wanted && std::isfinite(c.min_gap_between))
      limits.push_back(
          {"min_gap_between", "m", c.min_gap_between, -missed_depth * s.least_thickness, true,
           "where no node touches, a hundredth of the thickness: deeper, the nodes have missed the contact"});
    return;
  }
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
  return fmt::format("{} is {:.2g}{}{}, its limit {:.2g}{}{}", row, value, space, shown, limit, space, shown);
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
  limits.push_back(
      {"energy_identity", "1", c.energy_identity, of_thin_shells, false, "the work done is stored, to four digits"});
  return limits;
}

}  // namespace plastron::certificate
