// The certificate of a solution (docs/model.md, section 8), recomputed from displacements, strains and bounds alone.
#pragma once
#include <plastron/certificate/gap_between.hpp>
#include <plastron/solution/nodal_solution.hpp>
#include <plastron/solution/summary.hpp>

#include <limits>
#include <vector>

namespace plastron::certificate {

struct Certificate {
  // The denominators of ratios are at least the rounding of forces, moments and energies, which matters where
  // displacements hardly strain the shell.
  /// |residual on free coordinates| / |loads and reactions|, couples divided by the lever e
  double stationarity = 0;
  double min_pressure = 0;     ///< min eta_i over touching nodes [Pa]
  double min_gap_nodes = 0;    ///< min g_i [m]
  double min_gap_between = 0;  ///< min of the gap between the nodes [m]
  double support_error = 0;    ///< max |u.d - its value| and e |r.d - its value| over prescribed components [m]
  double complementarity = 0;  ///< max |eta_i (g_i - s_i)|, s_i the lift of the bound [Pa m]
  double force_balance = 0;    ///< |loads + obstacle + supports| / sum of the norms of all nodal forces and couples / e
  double moment_balance = 0;   ///< likewise for moments about the origin; decreases with h on curved charts
  /// |a(U,U) - l(U) - sum eta_i (g_i - g_i(0)) - support work| / a(U,U); NaN with finite rotations
  double energy_identity = std::numeric_limits<double>::quiet_NaN();
  /// |dW(U)[U] - f(U) . U| / max(|f(U) . U|, 2 W(U)), f the nodal forces of the stresses: energy and forces are computed by
  /// different loops. NaN with small rotations
  double energy_derivative = std::numeric_limits<double>::quiet_NaN();
};

struct Verdict {
  solution::Summary summary;
  Certificate certificate;
  std::vector<CellGap> entered{};  ///< this rank's cells with a gap below 0
};
/// Computes the summary, with areas and depths of contact, and the certificate. Moments are about the origin (collective).
Verdict certify(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

}  // namespace plastron::certificate
