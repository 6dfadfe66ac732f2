#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/pressing.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace plastron::contact {
namespace {

MPI_Comm comm_of(const BoxProblem& problem) { return problem.load.layout()->comm; }

bool is_active(Activity activity) { return activity == Activity::at_lower || activity == Activity::at_upper; }

std::int64_t count_over_ranks(const BoxProblem& problem, std::int64_t here) {
  return algebra::sum_over_ranks(here, comm_of(problem));
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
  assert_pressing_fits(problem);
}

bool bounds_are_consistent(const BoxProblem& problem) {
  std::int64_t contradictions = 0;
  for (std::size_t i = 0; i < problem.lower.owned().size(); ++i)
    if (!(problem.lower.owned()[i] <= problem.upper.owned()[i]) && !moves_apart_or_together(problem, i))
      ++contradictions;
  return count_over_ranks(problem, contradictions) == 0;
}

ActiveSet starting_set(const BoxProblem& problem, std::span<const Activity> initial) {
  const auto lower = problem.lower.owned();
  const auto upper = problem.upper.owned();
  algebra::in_agreement(comm_of(problem), [&] {
    if (!initial.empty() && initial.size() != lower.size())
      throw std::invalid_argument("an initial active set has one entry per owned unknown, or none at all");
  });
  ActiveSet set(lower.size(), Activity::free);
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (lower[i] == upper[i]) set[i] = Activity::prescribed;
    if (set[i] == Activity::prescribed || initial.empty()) continue;
    if (initial[i] == Activity::at_lower && std::isfinite(lower[i])) set[i] = Activity::at_lower;
    if (initial[i] == Activity::at_upper && std::isfinite(upper[i])) set[i] = Activity::at_upper;
  }
  return set;
}

ActiveSet everything_active(const BoxProblem& problem) {
  ActiveSet set = starting_set(problem, {});
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double lower = problem.lower.owned()[i];
    const double upper = problem.upper.owned()[i];
    if (set[i] == Activity::prescribed || (std::isinf(lower) && std::isinf(upper))) continue;
    set[i] = std::abs(lower) <= std::abs(upper) ? Activity::at_lower : Activity::at_upper;
  }
  return set;
}

ActiveSet everything_at_bounds(const BoxProblem& problem, const algebra::Vector& z) {
  ActiveSet set = starting_set(problem, {});
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (set[i] == Activity::prescribed) continue;
    if (z.owned()[i] <= problem.lower.owned()[i]) set[i] = Activity::at_lower;
    if (z.owned()[i] >= problem.upper.owned()[i]) set[i] = Activity::at_upper;
  }
  return set;
}

algebra::Vector project(const BoxProblem& problem, algebra::Vector z) {
  for (std::size_t i = 0; i < z.owned().size(); ++i)
    z.owned()[i] = std::clamp(z.owned()[i], problem.lower.owned()[i], problem.upper.owned()[i]);
  z.update_ghosts();
  return z;
}

BoxSolution unsolved(const BoxProblem& problem, Status status) {
  assert_fits_together(problem);
  const algebra::Vector zero(problem.load.layout(), problem.load.block());
  return {.status = status,
          .z = zero,
          .multiplier = zero,
          .activity = starting_set(problem, {}),
          .positions = std::vector<double>(problem.pressing.size(), 0.0),
          .iterations = {},
          .linear_residual = 0};
}

double held_at(const BoxProblem& problem, std::size_t i, Activity activity) {
  PLASTRON_ASSERT(i < problem.lower.owned().size() && activity != Activity::free, i, problem.lower.owned().size(),
                  static_cast<int>(activity));
  return activity == Activity::at_upper ? problem.upper.owned()[i] : problem.lower.owned()[i];
}

std::int64_t count_active(const BoxProblem& problem, const ActiveSet& set) {
  std::int64_t active = 0;
  for (const Activity activity : set) active += is_active(activity);
  return count_over_ranks(problem, active);
}

std::int64_t count_changes(const BoxProblem& problem, const ActiveSet& before, const ActiveSet& after) {
  PLASTRON_ASSERT(before.size() == after.size(), before.size(), after.size());
  std::int64_t changes = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changes += before[i] != after[i];
  return count_over_ranks(problem, changes);
}

// A sum of hashes, so that it does not depend on order or ranks. It may overflow and wrap.
std::uint64_t fingerprint(const BoxProblem& problem, const ActiveSet& set) {
  const auto first =
      static_cast<std::uint64_t>(problem.load.layout()->first) * static_cast<std::uint64_t>(problem.load.block());
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (is_active(set[i])) sum += algebra::hash(2 * (first + i) + (set[i] == Activity::at_upper));
  return std::bit_cast<std::uint64_t>(count_over_ranks(problem, std::bit_cast<std::int64_t>(sum)));
}

}  // namespace plastron::contact
