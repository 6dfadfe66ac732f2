#include <plastron/algebra/assertion.hpp>
#include <plastron/contact/pressing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

MPI_Comm ranks_of(const BoxProblem& problem) { return problem.load.layout()->comm; }

/// Whether force k presses the lower bound onto an owned unknown.
bool presses_from_below(const BoxProblem& problem, std::size_t k, std::size_t i) {
  return problem.pressing[k].lower_shape.owned()[i] > 0 && std::isfinite(problem.lower.owned()[i]);
}
bool presses_from_above(const BoxProblem& problem, std::size_t k, std::size_t i) {
  return problem.pressing[k].upper_shape.owned()[i] < 0 && std::isfinite(problem.upper.owned()[i]);
}

[[maybe_unused]] bool shapes_are_sound(const BoxProblem& problem, const PressingForce& pressing) {
  for (std::size_t i = 0; i < problem.lower.owned().size(); ++i) {
    const double below = pressing.lower_shape.owned()[i], above = pressing.upper_shape.owned()[i];
    if (!std::isfinite(below) || !std::isfinite(above)) return false;
    if (problem.lower.owned()[i] == problem.upper.owned()[i] && (below != 0 || above != 0)) return false;
  }
  return true;
}

/// A position at which a bound of an unknown meets z.
struct Meeting {
  double position;
  double noise;  ///< noise of the position
  Touch touch;
};

std::vector<Meeting> meetings_here(const BoxProblem& problem, const BoxProblem& box, std::size_t k,
                                   const algebra::Vector& z, const std::function<double(std::size_t)>& noise,
                                   double position) {
  const PressingForce& pressing = problem.pressing[k];
  std::vector<Meeting> meetings;
  const auto add = [&](std::size_t i, double bound, double shape, Activity activity) {
    meetings.push_back({.position = position + (z.owned()[i] - bound) / shape,
                        .noise = noise(i) / std::abs(shape),
                        .touch = {.unknown = i, .activity = activity}});
  };
  for (std::size_t i = 0; i < z.owned().size(); ++i) {
    if (presses_from_below(problem, k, i))
      add(i, box.lower.owned()[i], pressing.lower_shape.owned()[i], Activity::at_lower);
    if (presses_from_above(problem, k, i))
      add(i, box.upper.owned()[i], pressing.upper_shape.owned()[i], Activity::at_upper);
  }
  return meetings;
}

/// Returns the rate at which the bounds of an owned unknown approach each other, for each position.
std::vector<double> closing_of(const BoxProblem& problem, std::size_t i) {
  std::vector<double> closing;
  for (const PressingForce& pressing : problem.pressing)
    closing.push_back(pressing.lower_shape.owned()[i] - pressing.upper_shape.owned()[i]);
  return closing;
}

template <class Term>
std::vector<double> sums_over_active(const BoxProblem& problem, const ActiveSet& set, const Term& term) {
  std::vector<double> sums;
  for (const PressingForce& pressing : problem.pressing) {
    double sum = 0;
    for (std::size_t i = 0; i < set.size(); ++i) sum += term(i, shape_at(pressing, i, set[i]));
    sums.push_back(algebra::sum_over_ranks(sum, ranks_of(problem)));
  }
  return sums;
}

/// Whether positions change the width upper_i - lower_i of an owned unknown.
bool moves_apart_or_together(const BoxProblem& problem, std::size_t i) {
  return std::ranges::any_of(problem.pressing, [i](const PressingForce& pressing) {
    return pressing.lower_shape.owned()[i] != pressing.upper_shape.owned()[i];
  });
}

}  // namespace

void assert_fits_together([[maybe_unused]] const BoxProblem& problem) {
  PLASTRON_ASSERT(problem.apply, "an operator is missing");
  PLASTRON_ASSERT(problem.matrix.layout()->owned == problem.load.layout()->owned &&
                      problem.matrix.layout()->first == problem.load.layout()->first,
                  problem.matrix.layout()->first, problem.matrix.layout()->owned, problem.load.layout()->first,
                  problem.load.layout()->owned);
  PLASTRON_ASSERT(problem.load.block() == problem.matrix.block() && problem.lower.block() == problem.matrix.block() &&
                      problem.upper.block() == problem.matrix.block(),
                  problem.matrix.block(), problem.load.block(), problem.lower.block(), problem.upper.block());
  PLASTRON_ASSERT(problem.lower.owned().size() == problem.load.owned().size() &&
                      problem.upper.owned().size() == problem.load.owned().size(),
                  problem.load.owned().size(), problem.lower.owned().size(), problem.upper.owned().size());
  for ([[maybe_unused]] const PressingForce& pressing : problem.pressing) {
    PLASTRON_ASSERT(pressing.force > 0, pressing.force);
    PLASTRON_ASSERT(pressing.lower_shape.owned().size() == problem.load.owned().size() &&
                        pressing.upper_shape.owned().size() == problem.load.owned().size(),
                    pressing.lower_shape.owned().size(), pressing.upper_shape.owned().size(),
                    problem.load.owned().size());
    PLASTRON_ASSERT(shapes_are_sound(problem, pressing), "a shape is not finite, or moves a prescribed unknown");
  }
}

bool bounds_are_consistent(const BoxProblem& problem) {
  std::int64_t contradictions = 0;
  for (std::size_t i = 0; i < problem.lower.owned().size(); ++i)
    if (!(problem.lower.owned()[i] <= problem.upper.owned()[i]) && !moves_apart_or_together(problem, i))
      ++contradictions;
  return algebra::sum_over_ranks(contradictions, ranks_of(problem)) == 0;
}

BoxProblem at_positions(const BoxProblem& problem, std::span<const double> positions) {
  BoxProblem box{.matrix = problem.matrix,
                 .apply = problem.apply,
                 .load = problem.load,
                 .lower = problem.lower,
                 .upper = problem.upper,
                 .equations = problem.equations,
                 .shift = problem.shift,
                 .may_be_indefinite = problem.may_be_indefinite};
  move_bounds(problem, positions, box);
  return box;
}

void move_bounds(const BoxProblem& problem, std::span<const double> positions, BoxProblem& box) {
  PLASTRON_ASSERT(positions.size() == problem.pressing.size(), positions.size(), problem.pressing.size());
  box.lower = problem.lower;
  box.upper = problem.upper;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    algebra::axpy(positions[k], problem.pressing[k].lower_shape, box.lower);
    algebra::axpy(positions[k], problem.pressing[k].upper_shape, box.upper);
  }
}

bool bounds_cross(const BoxProblem& box, const algebra::Vector& noise) {
  std::int64_t crossed = 0;
  for (std::size_t i = 0; i < box.lower.owned().size(); ++i)
    crossed += box.lower.owned()[i] - box.upper.owned()[i] > noise.owned()[i];
  return algebra::sum_over_ranks(crossed, ranks_of(box)) > 0;
}

double shape_at(const PressingForce& pressing, std::size_t i, Activity activity) {
  if (activity == Activity::at_lower) return pressing.lower_shape.owned()[i];
  if (activity == Activity::at_upper) return pressing.upper_shape.owned()[i];
  return 0;
}

algebra::Vector active_shape(const PressingForce& pressing, const ActiveSet& set) {
  algebra::Vector shape(pressing.lower_shape.layout(), pressing.lower_shape.block());
  for (std::size_t i = 0; i < set.size(); ++i) shape.owned()[i] = shape_at(pressing, i, set[i]);
  return shape;
}

bool is_carried(const PressingForce& pressing, const ActiveSet& set) {
  return algebra::max_abs(active_shape(pressing, set)) > 0;
}

std::vector<double> reactions(const BoxProblem& problem, const algebra::Vector& multiplier, const ActiveSet& set) {
  return sums_over_active(problem, set, [&](std::size_t i, double shape) { return multiplier.owned()[i] * shape; });
}

std::vector<double> reaction_sizes(const BoxProblem& problem, const algebra::Vector& multiplier, const ActiveSet& set) {
  return sums_over_active(problem, set,
                          [&](std::size_t i, double shape) { return std::abs(multiplier.owned()[i] * shape); });
}

double work_of_forces(const BoxProblem& problem, std::span<const double> positions) {
  double work = 0;
  for (std::size_t k = 0; k < positions.size(); ++k) work += problem.pressing[k].force * positions[k];
  return work;
}

bool every_force_can_be_carried(const BoxProblem& problem) {
  bool can_be = true;
  for (std::size_t k = 0; k < problem.pressing.size(); ++k) {
    std::int64_t carriers = 0;
    for (std::size_t i = 0; i < problem.load.owned().size(); ++i)
      carriers += presses_from_below(problem, k, i) || presses_from_above(problem, k, i);
    can_be = algebra::sum_over_ranks(carriers, ranks_of(problem)) > 0 && can_be;
  }
  return can_be;
}

std::vector<Touch> touch(const BoxProblem& problem, std::size_t k, const algebra::Vector& z,
                         const std::function<double(std::size_t)>& noise, std::vector<double>& positions) {
  const auto meetings = meetings_here(problem, at_positions(problem, positions), k, z, noise, positions[k]);
  Meeting first{.position = never, .noise = 0, .touch = {}};
  for (const Meeting& meeting : meetings)
    if (meeting.position < first.position) first = meeting;
  const double position = algebra::min_over_ranks(first.position, ranks_of(problem));
  PLASTRON_ASSERT(std::isfinite(position), "the force can be carried", position);
  std::vector<Touch> touched;
  for (const Meeting& meeting : meetings)
    if (meeting.position - position <= meeting.noise) touched.push_back(meeting.touch);
  positions[k] = position;
  return touched;
}

std::optional<Wedge> first_wedge(const BoxProblem& problem, std::span<const double> positions,
                                 std::span<const double> direction) {
  const BoxProblem box = at_positions(problem, positions);
  const MPI_Comm comm = ranks_of(problem);
  const auto first = static_cast<double>(problem.load.layout()->first) * problem.load.block();
  double nearest = never;
  Wedge wedge;
  double unknown = never;
  for (std::size_t i = 0; i < box.lower.owned().size(); ++i) {
    const double width = std::max(0.0, box.upper.owned()[i] - box.lower.owned()[i]);
    if (!std::isfinite(width)) continue;
    const std::vector<double> closing = closing_of(problem, i);
    double speed = 0;
    for (std::size_t k = 0; k < direction.size(); ++k) speed += direction[k] * closing[k];
    if (!(speed > 0 && width <= speed && width < nearest * speed)) continue;
    nearest = width / speed;
    wedge = {.closing = closing, .width = width};
    unknown = first + static_cast<double>(i);
  }
  const double soonest = algebra::min_over_ranks(nearest, comm);
  if (std::isinf(soonest)) return {};
  const double owner = algebra::min_over_ranks(nearest == soonest ? unknown : never, comm);
  if (unknown != owner) wedge = {.closing = std::vector<double>(direction.size(), 0.0), .width = 0};
  for (double& closing : wedge.closing) closing = algebra::sum_over_ranks(closing, comm);
  wedge.width = algebra::sum_over_ranks(wedge.width, comm);
  return wedge;
}

}  // namespace plastron::contact
