#include <plastron/contact/pressed_subproblem.hpp>
#include <plastron/contact/pressing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

using algebra::Vector;

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

/// Returns z' D w.
double weighed(const Vector& z, const Vector& diagonal, const Vector& w) {
  Vector weights = w;
  for (std::size_t i = 0; i < weights.owned().size(); ++i) weights.owned()[i] *= diagonal.owned()[i];
  return algebra::dot(z, weights);
}

/// Returns the set of unknowns that touch before any motion: they are at a bound for z = 0, up to rounding.
ActiveSet everything_touching(const BoxProblem& problem) {
  constexpr double rounding = 1e-12;
  const auto lower = problem.lower.owned(), upper = problem.upper.owned();
  double largest = 0;
  for (std::size_t i = 0; i < lower.size(); ++i)
    for (const double bound : {lower[i], upper[i]})
      if (std::isfinite(bound)) largest = std::max(largest, std::abs(bound));
  const double nothing = rounding * algebra::max_over_ranks(largest, problem.load.layout()->comm);
  ActiveSet set = starting_set(problem, {});
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i] == Activity::prescribed) continue;
    if (lower[i] >= -nothing) set[i] = Activity::at_lower;
    if (upper[i] <= nothing) set[i] = Activity::at_upper;
  }
  return set;
}

/// Whether reactions balance every force up to rounding.
bool is_balanced(std::span<const double> misfit, std::span<const double> sizes) {
  constexpr double rounding = 16 * rounding_unit;
  for (std::size_t k = 0; k < misfit.size(); ++k)
    if (!(std::abs(misfit[k]) <= rounding * sizes[k])) return false;
  return true;
}

}  // namespace

PressedSubproblem::PressedSubproblem(const BoxProblem& problem, algebra::Preconditioner& preconditioner,
                                     const Settings& settings)
    : problem_(problem),
      box_(at_positions(problem, std::vector<double>(problem.pressing.size(), 0.0))),
      positions_(problem.pressing.size(), 0.0),
      subproblems_(box_, preconditioner, settings) {}

void PressedSubproblem::start_from(std::vector<double> positions) {
  positions_ = std::move(positions);
  move_bounds(problem_, positions_, box_);
}

std::optional<SubproblemPoint> PressedSubproblem::solve_first(std::span<const Activity> initial, ActiveSet& set) {
  const ActiveSet expected = set = starting_set(problem_, initial);
  if (auto point = solve(set)) return point;
  if (const ActiveSet touching = everything_touching(problem_);
      count_active(problem_, touching) > 0 && count_changes(problem_, touching, expected) > 0)
    if (auto point = solve(set = touching)) return point;
  // All bounds together would hide the motion that has no stiffness, and later sets would meet it again.
  if (problem_.may_be_indefinite && problem_.pressing.empty() && count_active(problem_, expected) > 0) return {};
  return solve(set = everything_active(problem_));
}

std::optional<SubproblemPoint> PressedSubproblem::solve(const ActiveSet& set) {
  const bool is_pressed = !problem_.pressing.empty();
  border_ = {};
  auto point = is_pressed ? subproblems_.solve_anew(set) : subproblems_.solve(set);
  failure_ = subproblems_.failure();
  if (!point || !is_pressed) return point;
  const auto answers = responses(set);
  failure_ = subproblems_.failure();
  if (!answers) return {};
  border_ = border_of(*answers);
  failure_ = Status::singular;
  if (!border_.free_motion().empty()) return {};
  point = settle(set, *answers, std::move(*point));
  if (point) finish(set, *point);
  return point;
}

std::optional<std::vector<PressedSubproblem::Response>> PressedSubproblem::responses(const ActiveSet& set) {
  std::vector<Response> all;
  for (std::size_t k = 0; k < problem_.pressing.size(); ++k) {
    if (!is_carried(problem_.pressing[k], set)) continue;
    Response response{.force = k, .z = {}, .forces = {}};
    auto linear = subproblems_.response(set, active_shape(problem_.pressing[k], set), response.z);
    if (!linear) return {};
    response.forces = std::move(linear->residual);
    for (double& value : response.forces.owned()) value = -value;
    all.push_back(std::move(response));
  }
  return all;
}

Border PressedSubproblem::border_of(const std::vector<Response>& responses) const {
  const std::size_t m = responses.size();
  SmallMatrix stiffness(m), factor_stiffness(m), scale(m);
  Vector forces(problem_.load.layout(), problem_.load.block());
  for (std::size_t k = 0; k < m; ++k) {
    problem_.matrix.multiply(responses[k].z, forces);
    for (std::size_t l = 0; l <= k; ++l) {
      const Vector& z = responses[l].z;
      stiffness(k, l) = stiffness(l, k) =
          0.5 * (algebra::dot(z, responses[k].forces) + algebra::dot(responses[k].z, responses[l].forces));
      factor_stiffness(k, l) = factor_stiffness(l, k) = algebra::dot(z, forces);
      scale(k, l) = scale(l, k) = weighed(z, subproblems_.diagonal(), responses[k].z);
    }
  }
  return Border::of(stiffness, factor_stiffness, scale);
}

/// Solves the border until the reactions equal the forces: the second step corrects the rounding of the first.
std::optional<SubproblemPoint> PressedSubproblem::settle(const ActiveSet& set, const std::vector<Response>& responses,
                                                         SubproblemPoint point) {
  constexpr int most_steps = 4;
  for (int step = 0; step < most_steps && !responses.empty(); ++step) {
    const auto all_reactions = reactions(problem_, point.multiplier, set);
    const auto all_sizes = reaction_sizes(problem_, point.multiplier, set);
    std::vector<double> misfit, sizes;
    for (const Response& response : responses) {
      misfit.push_back(problem_.pressing[response.force].force - all_reactions[response.force]);
      sizes.push_back(all_sizes[response.force]);
    }
    if (is_balanced(misfit, sizes)) break;
    const auto by = border_.solve(misfit);
    Vector z = std::move(point.z);
    for (std::size_t l = 0; l < responses.size(); ++l) {
      positions_[responses[l].force] += by[l];
      algebra::axpy(by[l], responses[l].z, z);
    }
    move_bounds(problem_, positions_, box_);
    const int linear_steps = point.linear_steps;
    auto next = subproblems_.refine(set, std::move(z));
    failure_ = subproblems_.failure();
    if (!next) return {};
    point = std::move(*next);
    point.linear_steps += linear_steps;
  }
  return point;
}

/// Completes the data that depend on the positions: touches of forces that nothing carries, the energy, the rounding of
/// bounds.
void PressedSubproblem::finish(const ActiveSet& set, SubproblemPoint& point) {
  const auto noise = [&](std::size_t i) { return point.gap_noise.owned()[i]; };
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    if (is_carried(problem_.pressing[k], set)) continue;
    const auto touched = touch(problem_, k, point.z, noise, positions_);
    point.touched.insert(point.touched.end(), touched.begin(), touched.end());
  }
  move_bounds(problem_, positions_, box_);
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    const PressingForce& pressing = problem_.pressing[k];
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double shape =
          std::max(std::abs(pressing.lower_shape.owned()[i]), std::abs(pressing.upper_shape.owned()[i]));
      double& value = point.gap_noise.owned()[i];
      value = std::max(value, 4 * rounding_unit * std::abs(positions_[k]) * shape);
    }
  }
  point.positions = positions_;
  point.energy -= work_of_forces(problem_, positions_);
}

}  // namespace plastron::contact
