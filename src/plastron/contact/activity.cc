#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/contact/activity.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plastron::contact {
namespace {

MPI_Comm comm_of(const BoxProblem& problem) { return problem.load.layout()->comm; }

bool is_active(Activity activity) { return activity == Activity::at_lower || activity == Activity::at_upper; }

std::int64_t count_over_ranks(const BoxProblem& problem, std::int64_t here) {
  return algebra::sum_over_ranks(here, comm_of(problem));
}

}  // namespace

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

double bound_at(const BoxProblem& problem, std::size_t i, Activity activity) {
  PLASTRON_ASSERT(i < problem.lower.owned().size() && activity != Activity::free, i, problem.lower.owned().size(),
                  static_cast<int>(activity));
  return activity == Activity::at_upper ? problem.upper.owned()[i] : problem.lower.owned()[i];
}

std::vector<char> fixed_by(const ActiveSet& set) {
  std::vector<char> marks(set.size());
  std::ranges::transform(set, marks.begin(), [](Activity activity) { return activity != Activity::free; });
  return marks;
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

algebra::Vector project(const BoxProblem& problem, algebra::Vector z) {
  for (std::size_t i = 0; i < z.owned().size(); ++i)
    z.owned()[i] = std::clamp(z.owned()[i], problem.lower.owned()[i], problem.upper.owned()[i]);
  z.update_ghosts();
  return z;
}

double largest_feasible_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d) {
  double largest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double step = d.owned()[i], z = x.owned()[i];
    if (step > 0) largest = std::min(largest, (z - lower.owned()[i]) / step);
    if (step < 0) largest = std::min(largest, (z - upper.owned()[i]) / step);
  }
  return algebra::min_over_ranks(largest, x.layout()->comm);
}

algebra::Vector clamped_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d, double t) {
  algebra::Vector result = x;
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double l = lower.owned()[i], u = upper.owned()[i], step = d.owned()[i];
    double& z = result.owned()[i];
    // The unknown that stops the step must be exactly at its bound in spite of rounding.
    const bool is_stopped = (step > 0 && (z - l) / step <= t) || (step < 0 && (z - u) / step <= t);
    z = is_stopped ? (step > 0 ? l : u) : std::clamp(z - t * step, l, u);
  }
  result.update_ghosts();
  return result;
}

}  // namespace plastron::contact
