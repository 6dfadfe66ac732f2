#include <plastron/computation/relinearisation.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plastron::computation {

namespace {

using assembly::node_values;
using assembly::Vector6;
using Eigen::Vector3d;

/// Whether the row's bound may differ from the gap for any obstacle.
bool is_inexact(const assembly::ContactRow& row) { return row.is_left_out || row.is_approximate; }

/// Calls check(row, obstacle, touches) for the contact rows of curved obstacles at owned nodes, and for inexact rows.
template <class Check>
void for_rows(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, const Check& check) {
  const auto obstacles = discrete.obstacles.all.size();
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    if (!is_inexact(row) && (!row.is_touchable() || discrete.obstacles.all[k].is_plane())) continue;
    check(row, k, solution.touching.local()[row.node * obstacles + k] != 0);
  }
}

/// Returns the largest distance of the faces in contact from their positions in the state, relative to their obstacles.
double distance_from_state(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  double farthest = 0;
  for_rows(discrete, solution, [&](const assembly::ContactRow& row, std::size_t k, bool touches) {
    if (!touches) return;
    const Vector6 way = node_values(solution.y, row.node) - discrete.state.at(row.node);
    const Vector3d r = geometry::tangential(way.tail<3>(), discrete.place(row.node).a3);
    const double arm = discrete.coordinates.gaps[k][row.node].arm;
    farthest = std::max(farthest, (way.head<3>() + arm * r - discrete.obstacles.way(k)).norm());
  });
  return algebra::max_over_ranks(farthest, discrete.space().layout->comm);
}

obstacle::ShellPoint moved_node(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                                const assembly::ContactRow& row) {
  const assembly::NodalPoint& p = discrete.place(row.node);
  return discrete.shell_point(p.phi, p.a3, p.thickness, discrete.in_coordinates(solution.y, row.node));
}

/// Prepares the obstacles for the true gaps of all rows.
void prepare_gap_error(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  std::vector<std::vector<Vector3d>> places(discrete.obstacles.all.size());
  for_rows(discrete, solution, [&](const assembly::ContactRow& row, std::size_t k, bool /*touches*/) {
    if (!discrete.obstacles.all[k].is_searched()) return;
    const obstacle::ShellPoint at = moved_node(discrete, solution, row);
    const Vector3d middle = at.phi + at.u;
    places[k].push_back(middle);
    places[k].push_back(middle + discrete.coordinates.gaps[k][row.node].z * (at.a3 + at.r));
  });
  for (std::size_t k = 0; k < places.size(); ++k) discrete.obstacles.now(k).prepare(places[k]);
}

/// Returns the gap error on this rank's nodes.
GapError gap_error_here(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                        const std::vector<obstacle::Reach>& reaches) {
  GapError error;
  prepare_gap_error(discrete, solution);
  for_rows(discrete, solution, [&](const assembly::ContactRow& row, std::size_t k, bool touches) {
    const obstacle::Gap& gap = discrete.coordinates.gaps[k][row.node];
    const obstacle::Obstacle now = discrete.obstacles.now(k);
    const obstacle::ShellPoint moved = moved_node(discrete, solution, row);
    const double distance =
        reaches.empty() ? obstacle::true_gap(now, gap, moved) : obstacle::true_gap(now, gap, moved, reaches[row.node]);
    const double closed = row.bed > 0 ? discrete.obstacles.all[k].bed.closure(solution.pressure.at(row.node)[k]) : 0;
    if (touches)
      error.at_contact = std::max(error.at_contact, std::abs(distance - discrete.nodal_gap(k, row.node, solution.y)));
    error.depth = std::max(error.depth, std::min(0.0, discrete.state.lift(row.node, k)) - distance - closed);
  });
  return error;
}

/// Whether some gap of the solution may differ from that of the state (collective).
bool has_inexact_gaps(const assembly::DiscreteShell& discrete) {
  const bool is_curved =
      std::ranges::any_of(discrete.obstacles.all, [](const obstacle::Obstacle& o) { return !o.is_plane(); });
  return is_curved || algebra::sum_over_ranks(std::int64_t{std::ranges::any_of(discrete.coordinates.rows, is_inexact)},
                                              discrete.space().layout->comm) > 0;
}

/// Returns Nearness::closure (collective).
double closure_error(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  if (!discrete.obstacles.has_segments()) return 0;
  double error = 0;
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    if (row.bed == 0) continue;
    const auto k = static_cast<std::size_t>(row.obstacle);
    const double entry = discrete.entry(row, solution.y);
    const double closure = discrete.obstacles.all[k].bed.closure(solution.pressure.at(row.node)[k]);
    error = std::max(error, solution.touching.at(row.node)[k] != 0 ? std::abs(closure - entry) : entry);
  }
  return algebra::max_over_ranks(error, discrete.space().layout->comm);
}

}  // namespace

bool has_rows_to_meet(const assembly::DiscreteShell& discrete) {
  return discrete.obstacles.has_segments() || has_inexact_gaps(discrete);
}

GapError gap_error(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  const MPI_Comm comm = discrete.space().layout->comm;
  const auto reaches = assembly::reaches_of(discrete.space(), discrete.present_points(), discrete.obstacles.all);
  const GapError mine =
      algebra::in_agreement<obstacle::ObstacleError>(comm, [&] { return gap_error_here(discrete, solution, reaches); });
  return {algebra::max_over_ranks(mine.at_contact, comm), algebra::max_over_ranks(mine.depth, comm)};
}

double least_thickness(const assembly::DiscreteShell& discrete) {
  double least = std::numeric_limits<double>::infinity();
  for (const assembly::NodalPoint& point : discrete.points) least = std::min(least, point.thickness);
  return algebra::min_over_ranks(least, discrete.space().layout->comm);
}

Nearness nearness(const problem::Linearisation& settings, const assembly::DiscreteShell& discrete,
                  const solution::NodalSolution& solution) {
  return {.distance = distance_from_state(discrete, solution),
          .depth = gap_error(discrete, solution).depth,
          .closure = closure_error(discrete, solution),
          .negligible = std::max(settings.tolerance * solution::largest_displacement(solution.y),
                                 assembly::gap_rounding * least_thickness(discrete))};
}

Relinearisation::Relinearisation(const problem::Linearisation& settings, const assembly::DiscreteShell& discrete)
    : settings_(settings), discrete_(discrete) {}

Relinearisation::Iterate Relinearisation::iterate(const solution::NodalSolution& solution) const {
  Iterate now;
  const auto add = [&](double from, double to) {
    now.at.push_back(from);
    now.way.push_back(to - from);
  };
  const auto from = discrete_.state.displacement.local(), to = solution.y.local();
  for (std::size_t i = 0; i < to.size(); ++i) add(from[i], to[i]);
  const std::vector<double> positions = discrete_.positions();
  for (std::size_t k = 0; k < positions.size(); ++k) add(discrete_.state.position(k), positions[k]);
  return now;
}

double Relinearisation::product(const std::vector<double>& a, const std::vector<double>& b) const {
  const algebra::Layout& layout = *discrete_.space().layout;
  double sum = 0;
  for (std::size_t i = 0; i < 6 * static_cast<std::size_t>(layout.owned); ++i)
    if (i % 6 < 3) sum += a[i] * b[i];
  return algebra::sum_over_ranks(sum, layout.comm);
}

void Relinearisation::correct(const Iterate& now, std::vector<double>& step) const {
  constexpr double independent = 1e-4, most = 100;
  std::vector<Iterate> changes;
  for (std::size_t j = 0; j < iterates_.size(); ++j) {
    const Iterate& next = j + 1 < iterates_.size() ? iterates_[j + 1] : now;
    Iterate& change = changes.emplace_back(next);
    for (std::size_t i = 0; i < change.at.size(); ++i) {
      change.at[i] -= iterates_[j].at[i];
      change.way[i] -= iterates_[j].way[i];
    }
  }
  const auto count = static_cast<Eigen::Index>(changes.size());
  Eigen::MatrixXd products(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::vector<double>& way = changes[static_cast<std::size_t>(j)].way;
    right[j] = product(way, now.way);
    for (Eigen::Index i = 0; i <= j; ++i)
      products(i, j) = products(j, i) = product(way, changes[static_cast<std::size_t>(i)].way);
  }
  // Changes of unlike size have the same weight; those that depend on the others are left out.
  const Eigen::VectorXd scale = products.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0)) return;
  const auto modes = geometry::symmetric_eigen(
      Eigen::MatrixXd(scale.cwiseInverse().asDiagonal() * products * scale.cwiseInverse().asDiagonal()));
  Eigen::VectorXd in_modes = modes.vectors.transpose() * right.cwiseQuotient(scale);
  for (Eigen::Index j = 0; j < count; ++j)
    in_modes[j] = modes.values[j] > independent * modes.values[count - 1] ? in_modes[j] / modes.values[j] : 0;
  const Eigen::VectorXd factors = (modes.vectors * in_modes).cwiseQuotient(scale);
  if (!(factors.cwiseAbs().maxCoeff() < most)) return;
  for (Eigen::Index j = 0; j < count; ++j)
    for (std::size_t i = 0; i < step.size(); ++i)
      step[i] -= factors[j] *
                 (changes[static_cast<std::size_t>(j)].at[i] + part_ * changes[static_cast<std::size_t>(j)].way[i]);
}

std::optional<assembly::State> Relinearisation::next(const solution::NodalSolution& solution) {
  constexpr std::size_t most_iterates = 5;
  constexpr int most_farther = 3;
  constexpr double least_part = 0.0625;
  constexpr int steps_to_come_near = 3;
  if (discrete_.obstacles.are_linear || !has_rows_to_meet(discrete_)) return {};
  const Nearness near = nearness(settings_, discrete_, solution);
  is_met_ = near.is_met();
  if (is_met_ || steps_ >= settings_.max_steps) return {};
  if (steps_ >= steps_to_come_near && solution::largest_rotation(solution.y) > meaningless_rotation) return {};
  const bool is_nearer = steps_ == 1 || near.distance < last_;
  part_ = is_nearer ? std::min(1.0, 2 * part_) : std::max(least_part, part_ / 2);
  farther_ = is_nearer ? 0 : farther_ + 1;
  if (farther_ == most_farther) {
    iterates_.clear();
    farther_ = 0;
  }
  last_ = near.distance;
  ++steps_;
  assembly::State state = discrete_.state;
  state.displacement = solution.y;
  state.positions = discrete_.positions();
  const bool is_deformed = discrete_.state.is_deformed();
  algebra::Vector way = solution.y;
  if (is_deformed) algebra::axpy(-1, discrete_.state.displacement, way);
  way.update_ghosts();
  if (const std::optional<double> part = part_by_beds(discrete_, solution.y, way)) {
    algebra::axpy(*part - 1, way, state.displacement);
    state.displacement.update_ghosts();
    for (std::size_t k = 0; k < state.positions.size(); ++k)
      state.positions[k] += (*part - 1) * discrete_.way_pressed(k);
    iterates_.clear();
    return state;
  }
  if (!is_deformed || !has_inexact_gaps(discrete_)) return state;
  Iterate now = iterate(solution);
  std::vector<double> step = now.way;
  for (double& value : step) value *= part_;
  if (!iterates_.empty()) correct(now, step);
  const auto values = state.displacement.local();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = now.at[i] + step[i];
  for (std::size_t k = 0; k < state.positions.size(); ++k)
    state.positions[k] = now.at[values.size() + k] + step[values.size() + k];
  iterates_.push_back(std::move(now));
  if (iterates_.size() > most_iterates) iterates_.pop_front();
  return state;
}

}  // namespace plastron::computation
