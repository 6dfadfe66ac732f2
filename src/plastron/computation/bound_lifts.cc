#include <plastron/algebra/agreement.hpp>
#include <plastron/certificate/gap_between.hpp>
#include <plastron/computation/bound_lifts.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/fem/cell_depths.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::computation {

namespace {

/// Limit of the depth in an obstacle, as a part of the thickness or of the largest displacement, whichever is larger.
constexpr double negligible = 1e-9;
/// Order of the norm of the cells' depths by which a node's lift grows. It exceeds the largest depth of eight cells by
/// at most a nineteenth.
constexpr int order = 40;
constexpr int max_rounds = 30;
/// A round without gain leaves more than this part of the least depth so far. A few of them may follow one another.
constexpr double gain = 0.9;
constexpr int max_rounds_without_gain = 4;
/// Part of the thickness. Nodes that need a greater lift do not see the obstacle: the mesh is too coarse.
constexpr double most_of_thickness = 0.25;
/// Lifts are lowered where the gap exceeds this part of them between nodes, too, and of the largest lift somewhere.
constexpr double allowance = 0.1;
constexpr int max_lowerings = 2;
/// Largest weight of fixed nodes at which lifts of the other nodes can reduce a depth.
constexpr double most_fixed = 0.5;

/// Intervals of the first lattice: at least twice the fineness of the reported gaps.
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

struct LeastGap {
  std::size_t cell, obstacle;
  double gap;  ///< [m]
};

/// Calls visit(cell, obstacle, least gap) for this rank's cells near obstacles.
template <class Counted, class Visit>
void visit_least_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double tolerance,
                      const Counted& counted, const Visit& visit) {
  const fem::Space& space = discrete.space();
  certificate::visit_gaps(discrete, y, [&](std::size_t cell, std::size_t k, const certificate::GapsAt& gaps_at) {
    visit(cell, k, fem::least_in_cell(space.shape(), lattice_intervals(space.degree), tolerance, [&](auto points) {
            const element::BasisAt at = element::basis_at(space.shape(), space.degree, {points.begin(), points.end()});
            return counted(cell, k, at.value, gaps_at(at));
          }));
  });
}

/// Returns the least gaps of this rank's cells. Where lifts reduce no depth, it does not count.
std::vector<LeastGap> least_gaps_here(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                                      double tolerance, const CellWeights& weights) {
  std::vector<LeastGap> all;
  const auto counted = [&](std::size_t cell, std::size_t k, const constraints::RowMatrix& basis,
                           std::vector<double> gaps) {
    const Eigen::VectorXd fixed = weights.fixed(cell, k, basis);
    for (std::size_t p = 0; p < gaps.size(); ++p)
      if (fixed[static_cast<Eigen::Index>(p)] > most_fixed) gaps[p] = std::max(gaps[p], 0.0);
    return gaps;
  };
  visit_least_gaps(discrete, y, tolerance, counted, [&](std::size_t cell, std::size_t k, double gap) {
    all.push_back({cell, k, gap});
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

/// Returns the least gap at the cell's nodes that have weight, less a part of their lifts.
double least_at_nodes(const assembly::DiscreteShell& discrete, const algebra::Vector& y, std::size_t cell,
                      std::size_t obstacle, double part = 0) {
  double least = std::numeric_limits<double>::infinity();
  for (const algebra::LocalIndex index : discrete.space().nodes(cell)) {
    const auto node = static_cast<std::size_t>(index);
    if (discrete.points[node].weight > 0)
      least = std::min(least, discrete.nodal_gap(obstacle, node, y) - part * discrete.state.lift(node, obstacle));
  }
  return least;
}

/// Returns for each owned node and obstacle the norm of numbers of its cells, of this order (collective). Sums are over ranks, because
/// a node on the border of two ranks has cells on both.
template <class Number>
algebra::Vector norms(const assembly::DiscreteShell& discrete, const std::vector<LeastGap>& cells,
                      const CellWeights& weights, const Number& number) {
  algebra::Vector sums(discrete.space().layout, discrete.state.lifts.block());
  const auto block = static_cast<std::size_t>(sums.block());
  for (const LeastGap& cell : cells)
    for (const algebra::LocalIndex node : weights.nodes(cell.cell))
      sums.local()[static_cast<std::size_t>(node) * block + cell.obstacle] += std::pow(number(cell.gap), order);
  sums.accumulate_ghosts();
  for (double& sum : sums.owned()) sum = std::pow(sum, 1.0 / order);
  return sums;
}

/// Raises the lifts of free nodes by the depths of their cells. Returns whether the mesh is fine enough for them (collective).
bool raise(const assembly::DiscreteShell& discrete, const algebra::Vector& y, std::vector<LeastGap> cells,
           const CellWeights& weights, const algebra::Vector& fixed, algebra::Vector& lifts) {
  const MPI_Comm comm = discrete.space().layout->comm;
  double deepest = 0;
  // Where no node of a deep cell is at its bound, the bound of the nearest one rises to its gap first.
  for (LeastGap& cell : cells) {
    const double way = least_at_nodes(discrete, y, cell.cell, cell.obstacle, 1);
    if (cell.gap < 0 && way > 0 && std::isfinite(way)) cell.gap -= way;
    deepest = std::max(deepest, -cell.gap);
  }
  deepest = algebra::max_over_ranks(deepest, comm);
  const algebra::Vector depths =
      norms(discrete, cells, weights, [&](double gap) { return std::max(0.0, -gap) / deepest; });
  const auto block = static_cast<std::size_t>(lifts.block());
  bool is_coarse = false;
  for (std::size_t k = 0; k < lifts.owned().size(); ++k) {
    if (fixed.owned()[k] == 0) lifts.owned()[k] += deepest * depths.owned()[k];
    is_coarse = is_coarse || lifts.owned()[k] > most_of_thickness * discrete.points[k / block].thickness;
  }
  return algebra::sum_over_ranks(std::int64_t{is_coarse}, comm) == 0;
}

/// Lowers the lifts that no depth needs. Returns whether this is worth another round (collective).
bool lower(const assembly::DiscreteShell& discrete, const algebra::Vector& touching, const std::vector<LeastGap>& cells,
           const CellWeights& weights, double tolerance, algebra::Vector& lifts) {
  const algebra::Vector inverse_gaps =
      norms(discrete, cells, weights, [&](double gap) { return tolerance / std::max(gap, tolerance); });
  const double notable = allowance * algebra::max_abs(lifts);
  bool is_lower = false;
  for (std::size_t k = 0; k < lifts.owned().size(); ++k) {
    double& lift = lifts.owned()[k];
    const bool touches = touching.owned()[k] != 0;
    const double excess = touches ? std::min(lift, tolerance / inverse_gaps.owned()[k]) : lift;
    if (excess <= std::max(allowance * lift, tolerance)) continue;
    is_lower = is_lower || (excess > notable && touches);
    lift -= excess;
  }
  return algebra::sum_over_ranks(std::int64_t{is_lower}, discrete.space().layout->comm) > 0;
}

}  // namespace

double largest_dip(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const MPI_Comm comm = discrete.space().layout->comm;
  const double tolerance = negligible * length_scale(discrete, y);
  double most = 0;
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
    const auto all = [](std::size_t, std::size_t, const constraints::RowMatrix&, std::vector<double> gaps) {
      return gaps;
    };
    visit_least_gaps(discrete, y, tolerance, all, [&](std::size_t cell, std::size_t k, double gap) {
      most = std::max(most, least_at_nodes(discrete, y, cell, k) - gap);
    });
  });
  return algebra::max_over_ranks(most, comm);
}

std::optional<algebra::Vector> BoundLifts::next(const solution::NodalSolution& solution) {
  const fem::Space& space = discrete_.space();
  const MPI_Comm comm = space.layout->comm;
  const double tolerance = negligible * length_scale(discrete_, solution.y);
  const algebra::Vector fixed = fixed_nodes(discrete_);
  const CellWeights weights(space, fixed);
  auto cells = algebra::in_agreement<obstacle::ObstacleError>(
      comm, [&] { return least_gaps_here(discrete_, solution.y, tolerance, weights); });
  double deepest = 0;
  for (const LeastGap& cell : cells) deepest = std::max(deepest, -cell.gap);
  deepest = algebra::max_over_ranks(deepest, comm);
  const bool is_inside = deepest > tolerance;
  if (rounds_ >= max_rounds) return {};
  rounds_without_gain_ = is_inside && deepest > gain * least_depth_ ? rounds_without_gain_ + 1 : 0;
  least_depth_ = is_inside ? std::min(least_depth_, deepest) : std::numeric_limits<double>::infinity();
  if (rounds_without_gain_ >= max_rounds_without_gain) return {};

  algebra::Vector lifts = discrete_.state.lifts;
  if (is_inside) {
    if (!raise(discrete_, solution.y, std::move(cells), weights, fixed, lifts)) return {};
  } else {
    if (!lower(discrete_, solution.touching, cells, weights, tolerance, lifts) || lowerings_ >= max_lowerings)
      return {};
    ++lowerings_;
  }
  ++rounds_;
  lifts.update_ghosts();
  return lifts;
}

}  // namespace plastron::computation
