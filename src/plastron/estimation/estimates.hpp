// What is estimated of the error of a solution on one mesh.
#pragma once
#include <array>
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

/// How a cell's squared error lies along xi_1 and xi_2: the parts of the whole that change along either, each by slices across it, one for
/// each of the k + 1 Gauss points, as wide as its weight. All parts together make 1, or 0 where there is no error (error_profiles.hpp).
using ErrorProfile = std::array<std::vector<double>, 2>;

/// A cell that the edge of a contact zone crosses.
struct CrossedCell {
  std::size_t cell = 0;
  int across = 0;            ///< along which of its directions one comes from the zone to what is free
  std::size_t touching = 0;  ///< how many of its nodes touch
};

struct Estimates {
  std::vector<double> cells{};           ///< squared error in the energy norm, a(e, e), of the owned cells [J]
  std::vector<ErrorProfile> profiles{};  ///< of the same cells; none of triangles
  double energy_norm_squared = 0;        ///< their sum over all ranks [J]
  std::vector<GoalEstimate> goals{};
  std::vector<CrossedCell> crossed{};  ///< owned ones, ascending
  /// Owned cells that no patch judges, ascending: their shares are too small.
  std::vector<std::size_t> unjudged{};
  std::int64_t unjudged_cells = 0;  ///< of all ranks
};

}  // namespace plastron::estimation
