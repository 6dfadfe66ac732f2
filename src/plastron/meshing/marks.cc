#include <plastron/meshing/marks.hpp>

#include <plastron/algebra/vector.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/meshing/chord_cuts.hpp>
#include <plastron/meshing/constants.hpp>
#include <plastron/meshing/sequence.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace plastron::meshing {

std::vector<double> error_indicators(const fem::Space& space, const std::vector<estimation::GoalRecord>& records,
                                     const estimation::Estimates& estimates) {
  std::vector<double> all(space.owned_cells, 0.0);
  for (std::size_t g = 0; g < records.size(); ++g) {
    const std::vector<double>& cells = estimates.goals[g].cells;
    for (std::size_t c = 0; c < cells.size(); ++c) all[c] = std::max(all[c], std::abs(cells[c]) / records[g].allowed());
  }
  return all;
}

double error_threshold(const std::vector<double>& indicators, double share, MPI_Comm comm) {
  double sum = 0, most = 0;
  for (const double x : indicators) {
    sum += x;
    most = std::max(most, x);
  }
  const double whole = algebra::sum_over_ranks(sum, comm);
  double at = algebra::max_over_ranks(most, comm);
  if (!(whole > 0)) return std::numeric_limits<double>::infinity();
  for (double part = 0; part < share * whole;) {
    at *= constants.threshold_step;
    double mine = 0;
    for (const double x : indicators)
      if (x > at) mine += x;
    part = algebra::sum_over_ranks(mine, comm);
  }
  return at;
}

std::vector<signed char> marks(const fem::Space& space, const std::vector<estimation::GoalRecord>& goals,
                               const estimation::Estimates& estimates, double share) {
  const std::vector<double> weights = error_indicators(space, goals, estimates);
  const double above = error_threshold(weights, share, space.layout->comm);
  // A cell made of four has about 2^(2k + 2) times their error. This must still be negligible.
  const double below = constants.joined_error * above * std::exp2(-2 * space.degree - 2);
  std::vector<signed char> result;
  result.reserve(weights.size());
  for (const double x : weights) result.push_back(x > above ? 1 : x < below ? -1 : 0);
  for (const std::size_t cell : estimates.unjudged) result[cell] = 1;
  return result;
}

double share_to_divide(double excess) {
  const double at_least = std::max(excess, 1.0);  // a mesh that only confirms must also be different
  return std::min((1 - constants.aim / at_least) / (1 - constants.kept_error), constants.most_divided);
}

namespace {

std::vector<signed char> marks_by_errors(const fem::Space& space, const NextMeshTask& task) {
  std::vector<signed char> all = marks(space, task.goals, *task.estimates, share_to_divide(task.excess));
  if (!task.may_join)
    std::ranges::replace_if(
        all, [](signed char mark) { return mark < 0; }, 0);
  if (task.wants_edges) {
    all.assign(space.owned_cells, 0);
    for (const estimation::CrossedCell& crossed : task.estimates->crossed) all[crossed.cell] = 1;
  }
  return all;
}

/// Returns the largest ratio of length and width that cuts leave.
double most_slender(const NextMeshTask& task) {
  return task.has_lost_stiffness ? constants.most_slender : std::numeric_limits<double>::infinity();
}

/// Returns cuts, if they are better than the division of the marked cells.
std::vector<mesh::Cuts> cuts_by_errors(const problem::Problem& problem, const fem::Space& space,
                                       const NextMeshTask& task, const std::vector<signed char>& marks) {
  const MPI_Comm comm = space.layout->comm;
  const std::vector<double> shares = error_indicators(space, task.goals, *task.estimates);
  double whole = 0, divided = 0, cells = 0;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    whole += shares[c];
    if (marks[c] > 0) {
      divided += shares[c];
      cells += 1;
    }
  }
  whole = algebra::sum_over_ranks(whole, comm);
  divided = algebra::sum_over_ranks(divided, comm);
  cells = algebra::sum_over_ranks(cells, comm);
  const auto is_held_at_point = [](const assembly::Support& support) { return support.point.has_value(); };
  return chord_cuts(space, fem::Surface(space.coarse, problem.charts),
                    {.shares = shares,
                     .estimates = *task.estimates,
                     .share = share_to_divide(task.excess),
                     .per_cell = cells > 0 && whole > 0 ? divided / whole / (3 * cells) : 0,
                     .halves_only = std::ranges::any_of(problem.shell.supports, is_held_at_point),
                     .are_met = std::ranges::all_of(task.goals, &estimation::GoalRecord::is_met),
                     .at_edges = task.wants_edges,
                     .most_slender = most_slender(task)});
}

/// Returns cuts through the marked cells, if they are better than the division of these cells.
std::vector<mesh::Cuts> cuts_of_marked(const problem::Problem& problem, const fem::Space& space,
                                       const std::vector<signed char>& marks, double slender) {
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < marks.size(); ++c)
    if (marks[c] > 0) cells.push_back(c);
  return cuts_through(space, fem::Surface(space.coarse, problem.charts), cells, slender);
}

/// Number of cells of all ranks with this mark (collective).
std::int64_t count_of(signed char mark, const NextMesh& next, const fem::Space& space) {
  return algebra::sum_over_ranks(std::int64_t{std::ranges::count(next.marks, mark)}, space.layout->comm);
}

}  // namespace

NextMesh next_mesh(const problem::Problem& problem, const fem::Space& space, const NextMeshTask& task) {
  const fem::MeshSequence::Even even = even_boundaries(problem);
  NextMesh next;
  if (task.follows_errors) {
    next.marks = marks_by_errors(space, task);
    if (even.empty()) next.cuts = cuts_by_errors(problem, space, task, next.marks);
  }
  // All cells where the goals' errors in cells cannot be distinguished.
  if (!task.follows_errors || count_of(1, next, space) == 0) next.marks.assign(space.owned_cells, 1);
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(task.entered.size()), space.layout->comm) > 0) {
    next.cuts.clear();
    const bool is_only_reason =
        task.lacks_contact || !task.estimates || estimation::shortfall(task.goals, *task.estimates).empty();
    if (is_only_reason) next.marks.assign(space.owned_cells, 0);
    for (const std::size_t cell : task.entered) next.marks[cell] = 1;
    if (is_only_reason && even.empty()) next.cuts = cuts_of_marked(problem, space, next.marks, most_slender(task));
  }
  fem::mark_evenly(space, even, next.marks);
  for (std::size_t c = 0; c < next.marks.size(); ++c)
    if (next.marks[c] > 0 && std::abs(space.cells[c].size) <= constants.smallest_cell) next.marks[c] = 0;
  next.has_joined = next.cuts.empty() && count_of(-1, next, space) > 0;
  const auto parts = [](const mesh::Cuts& cuts) {
    return static_cast<std::int64_t>((cuts[0].size() + 1) * (cuts[1].size() + 1));
  };
  next.added_cells = next.cuts.empty() ? 3 * count_of(1, next, space)
                                       : std::transform_reduce(next.cuts.begin(), next.cuts.end(), -space.global_cells,
                                                               std::plus{}, parts);
  return next;
}

}  // namespace plastron::meshing
