// Error estimates of a solution on one mesh.
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
  double estimate = 0;  ///< signed estimate of the exact value minus `value`, as far as its sign is known
  /// Possible contribution of the contact zone's edge, of either sign, >= 0: its place in the cells that it crosses
  /// is unknown. On a bed that of the kinks of its pressure.
  double contact_edge = 0;
  /// Part of `contact_edge` for true lines of contact beside rows of touching nodes. A higher degree with the same
  /// rows does not reveal it.
  double contact_line = 0;
  std::vector<double>
      cells{};  ///< shares of the owned cells: signed, and >= 0 where the contact zone's edge crosses the cell
  /// Part of `estimate` for layers of free edges, which polynomials in a cell do not represent (free_edges.hpp).
  double free_edges = 0;
  std::optional<double> at_higher_degree{};  ///< the same goal's value on the same cells at one degree more
  std::optional<double> geometry_error{};    ///< error by the mesh of the mid-surface, where it is known
  std::optional<double> tolerance{};         ///< relative tolerance of a goal with a required accuracy
  double scale = 0;        ///< to which relative errors refer: |value|, or a part of what is summed where sums cancel
  bool has_kinks = false;  ///< a sharp edge of an obstacle bends the shell inside of a cell
  double dual_energy = 0;  ///< 1/2 a(z, z): grows without bound under refinement if the functional is not bounded
  bool has_dual = true;    ///< false if the dual problem could not be solved; then the estimate lacks its part

  /// Returns the exact value minus `value`, signed, from the higher degree where it is known.
  double difference() const;
  /// Size of |exact value - value| according to recovered resultants.
  double recovered_error() const { return (estimate < 0 ? -estimate : estimate) + contact_edge; }
  /// Lower bound of the error, independent of the higher degree. Recovered resultants rarely overestimate it by more
  /// than five times, and lines of contact stay in place.
  double least_error() const;
  /// Estimate of |exact value - value| from all available data (docs/methods/estimates.md).
  double error() const;
};

/// Distribution of a cell's squared error along xi_1 and xi_2. Each direction has the parts of the error that change
/// along it, divided into slices across it. There is one slice for each of the k + 1 Gauss points, as wide as its
/// weight. The sum of all parts is 1, or 0 without error (strain_errors.hpp).
using ErrorProfile = std::array<std::vector<double>, 2>;

/// A cell crossed by the edge of a contact zone.
struct CrossedCell {
  std::size_t cell = 0;
  int across = 0;  ///< direction of the cell that leads from the zone to free nodes
  /// Where the zone reaches nodes that supports hold: the mean place in [0, 1] along `across` between touching nodes and
  /// these. No field shows this edge.
  std::optional<double> at_support{};
};

/// Distance of a mesh in space from the part that it describes, estimated (topology/surface_comparison.hpp).
struct GeometryDeviation {
  double largest = 0;             ///< [m]
  std::array<double, 3> place{};  ///< where it is [m]
  double judged_share = 0;        ///< share of the area where it could be estimated
};

struct Estimates {
  std::vector<double> cells{};           ///< squared error in the energy norm, a(e, e), of the owned cells [J]
  std::vector<ErrorProfile> profiles{};  ///< profiles of the same cells; empty for triangles
  double energy_norm_squared = 0;        ///< sum of `cells` over all ranks [J]
  std::vector<GoalEstimate> goals{};
  std::optional<GeometryDeviation> geometry{};  ///< only for meshes in space
  /// Distance that the edges of contact zones move at one degree more, over the zones' size
  /// (solution::relative_distance), where it is known.
  std::optional<double> edge_change{};
  std::vector<CrossedCell> crossed{};  ///< owned cells, ascending
  /// Owned cells without a patch, ascending: their shares are too small.
  std::vector<std::size_t> unjudged{};
  std::int64_t unjudged_cells = 0;  ///< sum over all ranks
};

}  // namespace plastron::estimation
