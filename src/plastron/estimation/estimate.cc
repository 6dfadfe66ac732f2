#include <plastron/estimation/estimate.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/estimation/bed_quadrature.hpp>
#include <plastron/estimation/contact_edge.hpp>
#include <plastron/estimation/lifted_bounds.hpp>
#include <plastron/estimation/strain_errors.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace plastron::estimation {

namespace {

using AllErrors = std::vector<StrainErrors>;

double over_ranks(const std::vector<double>& cells, MPI_Comm comm) {
  return algebra::sum_over_ranks(std::accumulate(cells.begin(), cells.end(), 0.0), comm);
}

/// Root of the sum of squares of the entries' sums over all ranks, as for independent errors.
double root_of_squares(const std::vector<double>& mine, MPI_Comm comm) {
  const std::vector<double> sums = algebra::sums_over_ranks(mine, comm);
  return std::sqrt(std::inner_product(sums.begin(), sums.end(), sums.begin(), 0.0));
}

/// Adds the dual estimate of J(u) - J(u_h) from the dual z, cell by cell: int e_u : C : e_z minus the tying products
/// of both.
void add_dual_shares(const energy::ShellOperator& shell, const AllErrors& u, const AllErrors& z,
                     std::vector<double>& cells) {
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c] += energy_product(shell, c, u[c], z[c]) - tying_product(u[c], z[c]) - tying_product(z[c], u[c]);
}

/// Adds the quadratic part of E(u) - E(u_h): `sign` times 1/2 a(e, e) minus the tying product.
void add_energy_shares(const energy::ShellOperator& shell, const AllErrors& u, double sign,
                       std::vector<double>& cells) {
  for (std::size_t c = 0; c < cells.size(); ++c)
    cells[c] += sign * (energy_product(shell, c, u[c], u[c]) / 2 - tying_product(u[c], u[c]));
}

/// Part of the energy products on free edges, on this rank.
double twist_product(const AllErrors& u, const AllErrors& z) {
  return std::inner_product(
      u.begin(), u.end(), z.begin(), 0.0, std::plus{},
      [](const StrainErrors& a, const StrainErrors& b) { return a.edge_twist.dot(b.edge_twist); });
}

/// Half of the area between two nodes along the edge of a contact zone: the edge may lie anywhere between them. Their
/// distance is the k-th part of a cell.
double area_share(const energy::ShellOperator& shell, std::size_t cell) {
  return shell.area(cell) / (2.0 * shell.space().degree);
}

bool weighs_nothing(const DualLoad& dual) {
  return algebra::max_abs(dual.load) == 0 && algebra::max_abs(dual.fixed) == 0 &&
         std::ranges::all_of(dual.positions, [](double p) { return p == 0; });
}

class GoalEstimator {
 public:
  GoalEstimator(const Solved& solved, algebra::Preconditioner& preconditioner, const AllErrors& primal,
                const StrainRecovery& strain_errors, const ContactEdge& edge)
      : solved_(solved),
        primal_(primal),
        strain_errors_(strain_errors),
        edge_(edge),
        lifted_(solved),
        bed_(solved),
        has_strain_errors_(edge.crossed().size(), 0),
        duals_(solved.box, solved.z, preconditioner) {}

  GoalEstimate operator()(const Goal& goal) {
    const energy::ShellOperator& shell = solved_.discrete.shell;
    const Derivative d = derivative(goal.functional, solved_);
    GoalEstimate result{.name = goal.name,
                        .unit = unit_of(goal.functional),
                        .value = d.value,
                        .cells = std::vector<double>(shell.space().owned_cells, 0),
                        .tolerance = goal.tolerance,
                        .has_kinks = edge_.has_kinks()};
    if (d.energy_part != 0) {
      add_energy_shares(shell, primal_, d.energy_part, result.cells);
      result.free_edges += d.energy_part * twist_product(primal_, primal_) / 2;
    }
    EdgeShares at_edge(edge_.crossed().size());
    std::vector<double> by_lifts(result.cells.size(), 0);
    double quadratic_by_lifts = 0;
    if (std::holds_alternative<ContactArea>(goal.functional))
      std::ranges::transform(edge_.crossed(), at_edge.all.begin(), [&](std::size_t c) { return area_share(shell, c); });
    if (!weighs_nothing(d.dual)) {
      const auto z = duals_.solve(d.dual);
      result.has_dual = z.has_value();
      if (z) {
        at_edge = add_dual(d, *z, result);
        by_lifts = lifted_.shares(z->multiplier);
      }
    } else if (
        d.weighs_gaps) {  // where the touching nodes have no gap before the shell deforms; depths between nodes count
      at_edge = edge_.shares(d, duals_.zero(), algebra::Vector(d.dual.load.layout(), 6));
    }
    if (result.has_dual && d.energy_part != 0) quadratic_by_lifts = energy_of_lifts();
    sum_up(at_edge, result);
    add_lifts(by_lifts, quadratic_by_lifts, result);
    result.free_edges = algebra::sum_over_ranks(result.free_edges, shell.space().layout->comm);
    return result;
  }

  /// Whether the strains in a crossed cell contribute more to some goal than the zone's edge does.
  bool has_strain_errors(std::size_t crossed) const { return has_strain_errors_[crossed] != 0; }

 private:
  /// Adds the dual estimate. Returns the shares of the contact zone's edge.
  EdgeShares add_dual(const Derivative& d, const DualSolution& z, GoalEstimate& result) {
    algebra::Vector y(z.z.layout(), 6);
    solved_.discrete.coordinates.to_cartesian(z.z, y);
    result.dual_energy = solved_.discrete.motion_energies(y).total();
    const AllErrors dual = strain_errors_.of_motion(y);
    add_dual_shares(solved_.discrete.shell, primal_, dual, result.cells);
    result.contact_edge += bed_.add_shares(d, z, y, result.cells);
    result.free_edges += twist_product(primal_, dual);
    return edge_.shares(d, z, y);
  }

  /// Energy of the motion back to bounds without lifts; 0 where they change nothing or linear equations fail.
  double energy_of_lifts() {
    if (!lifted_.any()) return 0;
    const auto back = duals_.solve(lifted_.way_back());
    if (!back) return 0;
    algebra::Vector y(back->z.layout(), 6);
    solved_.discrete.coordinates.to_cartesian(back->z, y);
    return solved_.discrete.motion_energies(y).total();
  }

  /// Adds the change by lifts, without sign: the exact solution may lie on either side of the one without lifts.
  void add_lifts(const std::vector<double>& cells, double quadratic, GoalEstimate& result) const {
    if (!lifted_.any()) return;
    result.contact_edge += std::abs(over_ranks(cells, solved_.discrete.space().layout->comm) + quadratic);
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (cells[c] != 0) result.cells[c] = std::abs(result.cells[c]) + std::abs(cells[c]);
  }

  /// Adds up the shares of all cells. In cells crossed by the edge of a contact zone the sign of a share is unknown.
  void sum_up(const EdgeShares& at_edge, GoalEstimate& result) {
    const fem::Space& space = solved_.discrete.space();
    std::vector<double> smooth = result.cells, edge(static_cast<std::size_t>(space.nodes_per_cell()) + 1, 0),
                        lines = edge;
    for (std::size_t i = 0; i < at_edge.all.size(); ++i) {
      const std::size_t cell = edge_.crossed()[i];
      smooth[cell] = 0;
      if (std::abs(result.cells[cell]) > at_edge.all[i]) has_strain_errors_[i] = 1;
      result.cells[cell] = std::max(std::abs(result.cells[cell]), at_edge.all[i]);
      edge[edge_.touching_nodes()[i]] += result.cells[cell];
      lines[edge_.touching_nodes()[i]] += at_edge.lines[i];
    }
    result.estimate = over_ranks(smooth, space.layout->comm);
    result.contact_edge += root_of_squares(edge, space.layout->comm);
    result.contact_line = root_of_squares(lines, space.layout->comm);
  }

  const Solved& solved_;
  const AllErrors& primal_;
  const StrainRecovery& strain_errors_;
  const ContactEdge& edge_;
  LiftedBounds lifted_;
  BedQuadrature bed_;
  std::vector<char> has_strain_errors_;
  DualSolver duals_;
};

/// Returns the profile of an error at a place along a direction.
ErrorProfile profile_at(double place, std::size_t direction, int degree) {
  const std::vector<double> widths = mesh::gauss(degree + 1).weights;
  const std::vector<double> none(widths.size(), 0);
  ErrorProfile profile{none, none};
  std::size_t slice = 0;
  for (double end = widths[0]; end < place && slice + 1 < widths.size(); end += widths[slice]) ++slice;
  profile[direction][slice] = 1;
  return profile;
}

std::vector<CrossedCell> crossed_cells(const ContactEdge& edge) {
  std::vector<CrossedCell> cells;
  for (std::size_t i = 0; i < edge.crossed().size(); ++i)
    cells.push_back({edge.crossed()[i], edge.across()[i], edge.at_support()[i]});
  return cells;
}

}  // namespace

Estimates estimate(const Solved& solved, algebra::Preconditioner& preconditioner, std::span<const Goal> goals) {
  const energy::ShellOperator& shell = solved.discrete.shell;
  const std::vector<FreeEdge> at_edges = free_edges(solved.discrete);
  StrainRecovery strain_errors(solved.discrete, at_edges);
  const AllErrors primal = strain_errors.of_solution(solved.nodal);
  const ContactEdge edge(solved);
  Estimates estimates{.cells = std::vector<double>(primal.size()),
                      .profiles = error_profiles(shell, primal),
                      .crossed = crossed_cells(edge)};
  for (std::size_t c = 0; c < primal.size(); ++c) estimates.cells[c] = energy_product(shell, c, primal[c], primal[c]);
  estimates.energy_norm_squared = over_ranks(estimates.cells, shell.space().layout->comm);
  for (std::size_t c = 0; c < primal.size(); ++c)
    if (!primal[c].has_patch) estimates.unjudged.push_back(c);
  estimates.unjudged_cells =
      algebra::sum_over_ranks(static_cast<std::int64_t>(estimates.unjudged.size()), shell.space().layout->comm);
  GoalEstimator estimator(solved, preconditioner, primal, strain_errors, edge);
  for (const Goal& goal : goals) estimates.goals.push_back(estimator(goal));
  for (std::size_t i = 0; i < estimates.crossed.size() && !estimates.profiles.empty(); ++i) {
    const CrossedCell& crossed = estimates.crossed[i];
    if (crossed.at_support && !estimator.has_strain_errors(i))
      estimates.profiles[crossed.cell] =
          profile_at(*crossed.at_support, static_cast<std::size_t>(crossed.across), shell.space().degree);
  }
  return estimates;
}

}  // namespace plastron::estimation
