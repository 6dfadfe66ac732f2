#include <plastron/algebra/agreement.hpp>
#include <plastron/certificate/gap_between.hpp>
#include <plastron/computation/bound_lifts.hpp>
#include <plastron/computation/cell_depths.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::computation {

namespace {

/// Limit of the depth in an obstacle, as a part of the thickness or of the largest displacement, whichever is larger.
constexpr double negligible = 1e-9;
/// Order of the norm of the cells' depths by which a node's lift grows. It exceeds the largest depth by at most a
/// seventh.
constexpr int order = 16;
constexpr int max_rounds = 30;
/// A round without gain leaves more than this part of the least depth so far. A few of them may follow one another.
constexpr double gain = 0.9;
constexpr int max_rounds_without_gain = 4;
/// Largest weight of fixed nodes at which lifts of the other nodes can reduce a depth.
constexpr double most_fixed = 0.5;

/// Returns at least twice the fineness of the reported gaps.
int lattice_intervals(int degree) { return std::max(8, 4 * degree); }

/// The free nodes of a cell, and the weight of fixed nodes at the points of a basis. Supports fix these nodes against
/// an obstacle.
class CellWeights {
 public:
  CellWeights(const fem::Space& space, const algebra::Vector& fixed) : space_(space), fixed_(fixed) {}

  std::vector<algebra::LocalIndex> nodes(std::size_t cell) const {
    return space_.continuity.sources(space_.nodes(cell));
  }
  Eigen::VectorXd fixed(std::size_t cell, std::size_t obstacle, const constraints::RowMatrix& basis) const {
    const auto [free, values] = space_.continuity.on_sources(space_.nodes(cell), basis);
    Eigen::VectorXd marks(static_cast<Eigen::Index>(free.size()));
    for (std::size_t i = 0; i < free.size(); ++i)
      marks[static_cast<Eigen::Index>(i)] =
          fixed_.local()[static_cast<std::size_t>(free[i]) * static_cast<std::size_t>(fixed_.block()) + obstacle];
    return values * marks;
  }

 private:
  const fem::Space& space_;
  const algebra::Vector& fixed_;
};

/// Returns 1 where supports leave a node's gap no freedom, or where the node is constrained (collective).
algebra::Vector fixed_nodes(const assembly::DiscreteShell& discrete) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  algebra::Vector fixed(discrete.space().layout, static_cast<int>(coordinates.gaps.size()));
  for (const assembly::ContactRow& row : coordinates.rows)
    fixed.owned()[row.node * coordinates.gaps.size() + static_cast<std::size_t>(row.obstacle)] =
        !row.is_touchable() && !row.is_left_out &&
        (!std::isnan(row.bound_gap) || discrete.space().constraints.constrains(row.node));
  fixed.update_ghosts();
  return fixed;
}

struct CellDepth {
  std::size_t cell, obstacle;
  double depth;  ///< [m]
};

/// Returns this rank's cells that are partly inside an obstacle.
std::vector<CellDepth> depths_here(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                                   const CellWeights& weights) {
  const fem::Space& space = discrete.space();
  const int intervals = lattice_intervals(space.degree);
  const LatticeBound bound(space.shape(), intervals);
  const constraints::RowMatrix basis =
      element::basis_at(space.shape(), space.degree, mesh::lattice(space.shape(), intervals)).value;
  std::vector<CellDepth> all;
  certificate::sample_gaps(discrete, y, intervals,
                           [&](std::size_t cell, std::size_t obstacle, std::span<const double> gaps) {
                             const Eigen::VectorXd fixed = weights.fixed(cell, obstacle, basis);
                             double depth = 0;
                             for (std::size_t p = 0; p < gaps.size(); ++p)
                               if (fixed[static_cast<Eigen::Index>(p)] <= most_fixed)
                                 depth = std::max(depth, -bound.at(p, gaps));
                             if (depth > 0) all.push_back({cell, obstacle, depth});
                           });
  return all;
}

/// Returns the largest thickness or displacement, whichever is larger (collective).
double length_scale(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    most = std::max({most, discrete.points[i].thickness, assembly::node_values(y, i).head<3>().norm()});
  return algebra::max_over_ranks(most, discrete.space().layout->comm);
}

/// Returns the least gap at the cell's nodes that have weight.
double least_at_nodes(const assembly::DiscreteShell& discrete, const algebra::Vector& y, std::size_t cell,
                      std::size_t obstacle) {
  double least = std::numeric_limits<double>::infinity();
  for (const algebra::LocalIndex index : discrete.space().nodes(cell)) {
    const auto node = static_cast<std::size_t>(index);
    if (discrete.points[node].weight > 0) least = std::min(least, discrete.nodal_gap(obstacle, node, y));
  }
  return least;
}

}  // namespace

double largest_dip(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const MPI_Comm comm = discrete.space().layout->comm;
  double most = 0;
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
    certificate::sample_gaps(discrete, y, lattice_intervals(discrete.space().degree),
                             [&](std::size_t cell, std::size_t obstacle, std::span<const double> gaps) {
                               const double least = least_at_nodes(discrete, y, cell, obstacle);
                               most = std::max(most, least - *std::ranges::min_element(gaps));
                             });
  });
  return algebra::max_over_ranks(most, comm);
}

std::optional<algebra::Vector> BoundLifts::next(const solution::NodalSolution& solution) {
  const fem::Space& space = discrete_.space();
  const MPI_Comm comm = space.layout->comm;
  const algebra::Vector fixed = fixed_nodes(discrete_);
  const CellWeights weights(space, fixed);
  const auto cells =
      algebra::in_agreement<obstacle::ObstacleError>(comm, [&] { return depths_here(discrete_, solution.y, weights); });
  double deepest = 0;
  for (const CellDepth& cell : cells) deepest = std::max(deepest, cell.depth);
  deepest = algebra::max_over_ranks(deepest, comm);
  if (deepest <= negligible * length_scale(discrete_, solution.y)) return {};
  rounds_without_gain_ = deepest > gain * least_depth_ ? rounds_without_gain_ + 1 : 0;
  least_depth_ = std::min(least_depth_, deepest);
  if (rounds_ >= max_rounds || rounds_without_gain_ >= max_rounds_without_gain) return {};
  ++rounds_;

  // Sums are over ranks, because a node on the border of two ranks has cells on both.
  algebra::Vector powers(space.layout, fixed.block());
  const auto block = static_cast<std::size_t>(fixed.block());
  for (const CellDepth& cell : cells)
    for (const algebra::LocalIndex node : weights.nodes(cell.cell))
      powers.local()[static_cast<std::size_t>(node) * block + cell.obstacle] += std::pow(cell.depth / deepest, order);
  powers.accumulate_ghosts();
  algebra::Vector lifts = discrete_.state.lifts;
  for (std::size_t k = 0; k < lifts.owned().size(); ++k)
    if (fixed.owned()[k] == 0) lifts.owned()[k] += deepest * std::pow(powers.owned()[k], 1.0 / order);
  lifts.update_ghosts();
  return lifts;
}

}  // namespace plastron::computation
