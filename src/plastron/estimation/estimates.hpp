// What is estimated of the error of a solution on one mesh.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
  /// The part of that for true lines of contact beside the rows of nodes that touch, which a higher degree with the same rows does not see.
  double contact_line = 0;
  std::vector<double>
      cells{};  ///< shares of the owned cells: signed, and >= 0 where the contact zone's edge crosses the cell
  /// The part of `estimate` for layers of free edges, which no polynomial in a cell sees (free_edges.hpp).
  double free_edges = 0;
  std::optional<double> at_higher_degree{};  ///< the same number of the solution on the same cells at one degree more
  std::optional<double> tolerance{};         ///< relative, where it is asked for to an accuracy
  double dual_energy = 0;  ///< 1/2 a(z, z): grows without bound with refinement where the functional is not finite
  bool has_dual = true;    ///< false: the dual problem could not be solved, and the estimate lacks its part

  /// Signed: of the exact value minus `value`, by the higher degree where it is known.
  double difference() const;
  /// The size of |exact value - value| as recovered resultants have it.
  double recovered_error() const { return (estimate < 0 ? -estimate : estimate) + contact_edge; }
  /// What is left of that whatever a higher degree says: recovered resultants are rarely more than five times too large, and lines of contact
  /// stay where they are.
  double least_error() const;
  /// The same by all that is known (docs/methods/estimates.md).
  double error() const;
};

/// How a cell's squared error lies along xi_1 and xi_2: the parts of the whole that change along either, each by slices across it, one for
/// each of the k + 1 Gauss points, as wide as its weight. All parts together make 1, or 0 where there is no error (error_profiles.hpp).
using ErrorProfile = std::array<std::vector<double>, 2>;

/// A cell that the edge of a contact zone crosses.
struct CrossedCell {
  std::size_t cell = 0;
  int across = 0;  ///< along which of its directions one comes from the zone to what is free
};

struct Estimates {
  std::vector<double> cells{};           ///< squared error in the energy norm, a(e, e), of the owned cells [J]
  std::vector<ErrorProfile> profiles{};  ///< of the same cells; none of triangles
  double energy_norm_squared = 0;        ///< their sum over all ranks [J]
  std::vector<GoalEstimate> goals{};
  /// How far the edges of contact zones move at one degree more, over the zones' size (certificate::relative_distance), where that is known.
  std::optional<double> edge_change{};
  std::vector<CrossedCell> crossed{};  ///< owned ones, ascending
  /// Owned cells that no patch judges, ascending: their shares are too small.
  std::vector<std::size_t> unjudged{};
  std::int64_t unjudged_cells = 0;  ///< of all ranks
};

/// How far a solution of the linear model is from what finite displacements would make of it (linearity.hpp).
struct Linearity {
  /// What of assembly::SecondOrder::stretch is left after the best further displacement [J].
  std::optional<double> remaining_stretch{};
  /// Largest mu with -K_N v = mu A v, K_N the geometric stiffness of N^{ab}, contact held: 1 where the shell buckles.
  std::optional<double> buckling{};
};

}  // namespace plastron::estimation
