// What is estimated of the error of a solution on one mesh.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plastron::estimation {

struct GoalEstimate {
  std::string name{};
  std::string unit{};
  double value = 0;
  double estimate = 0;  ///< signed: of the exact value minus `value`, as far as its sign can be known
  /// What the edge of the contact zone may add to that, of either sign: it lies somewhere inside of the cells that it crosses, >= 0.
  double contact_edge = 0;
  std::vector<double>
      cells{};  ///< shares of the owned cells: signed, and >= 0 where the contact zone's edge crosses the cell
  double dual_energy = 0;  ///< 1/2 a(z, z): grows without bound with refinement where the functional is not finite
  bool has_dual = true;    ///< false: the dual problem could not be solved, and the estimate lacks its part

  /// The largest that |exact value - value| is thought to be.
  double error() const { return (estimate < 0 ? -estimate : estimate) + contact_edge; }
};

struct Estimates {
  std::vector<double> cells{};     ///< squared error in the energy norm, a(e, e), of the owned cells [J]
  double energy_norm_squared = 0;  ///< their sum over all ranks [J]
  std::vector<GoalEstimate> goals{};
  /// Owned cells that the edge of a contact zone crosses, ascending.
  std::vector<std::size_t> crossed{};
  /// Owned cells that no patch judges, ascending: their shares are too small.
  std::vector<std::size_t> unjudged{};
  std::int64_t unjudged_cells = 0;  ///< of all ranks
};

}  // namespace plastron::estimation
