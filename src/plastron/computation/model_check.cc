#include <plastron/computation/model_check.hpp>

#include <plastron/finite/newton_step.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::computation {

namespace {

/// Below this part of the sum of the norms of all nodal forces a force is not judged.
constexpr double small_force = 1e-3;

constexpr int most_steps = 8;
/// Change of a number by a step, relative, above which its numbers are rough.
constexpr double rough_change = 0.1;

double nodal_contact_area(const Solution& solution) {
  double area = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(solution.discrete->space().layout->owned); ++i)
    for (const double touches : solution.nodal.touching.at(i))
      area += touches > 0.5 ? solution.discrete->points[i].weight : 0;
  return algebra::sum_over_ranks(area, solution.discrete->space().layout->comm);
}

/// Returns the numbers that are compared, with their values in the linear model.
std::vector<ModelQuantity> linear_numbers(const solution::Summary& summary) {
  std::vector<ModelQuantity> numbers{{.name = "energy",
                                      .unit = "J",
                                      .linear = summary.energy.total(),
                                      .least = std::max(summary.rounding_energy, summary.least_energy())}};
  const double force = small_force * summary.force_scale();
  for (const solution::ObstacleContact& obstacle : summary.obstacles)
    numbers.push_back(
        {.name = summary.obstacles.size() == 1 ? "reaction" : fmt::format("obstacle.{}.force", obstacle.name),
         .unit = "N",
         .linear = obstacle.reaction.force.norm(),
         .least = force});
  numbers.push_back({.name = "max_displacement",
                     .unit = "m",
                     .linear = summary.max_displacement,
                     .least = summary.least_displacement()});
  if (!summary.obstacles.empty())
    numbers.push_back({.name = "contact_area", .unit = "m^2", .linear = summary.contact_area, .is_judged = false});
  for (ModelQuantity& number : numbers) number.finite = number.linear;
  return numbers;
}

/// Returns the largest relative change of numbers that are judged.
double largest_change(const std::vector<ModelQuantity>& before, const std::vector<ModelQuantity>& now) {
  double largest = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double change = std::abs(now[i].finite - before[i].finite),
                 scale = std::max(std::abs(now[i].finite), now[i].least);
    if (now[i].is_judged && change > largest * scale) largest = change / scale;
  }
  return largest;
}

/// Sets the values after a step, whose end has this largest displacement.
void set_finite_values(const finite::StepTotals& totals, double displacement, const Solution& solution,
                       std::vector<ModelQuantity>& numbers) {
  std::size_t next = 0;
  numbers[next++].finite = totals.energy;
  for (const Eigen::Vector3d& force : totals.obstacle_forces) numbers[next++].finite = force.norm();
  numbers[next++].finite = displacement;
  if (next == numbers.size()) return;
  // Nodal areas in contact are coarser than areas within the boundaries of zones: their ratio is used.
  const double nodal = nodal_contact_area(solution);
  numbers[next].finite = nodal > 0 ? numbers[next].linear * totals.contact_area / nodal : 0;
}

}  // namespace

ModelCheck check_model(const Solution& solution, const solution::Summary& summary, const contact::Settings& settings,
                       const Observer& observer) {
  const assembly::DiscreteShell& linear = *solution.discrete;
  const contact::Observer follow{.stop = [&] { return wants_to_stop(observer, linear.space().layout->comm); }};
  const auto discrete = finite::with_finite_rotations(linear, solution.nodal);
  finite::StepStart start{.prestress = finite::prestress(linear, solution.nodal), .zone = solution.nodal.touching};
  ModelCheck check;
  std::vector<ModelQuantity> numbers = linear_numbers(summary);
  for (bool is_rough = true; is_rough && check.steps < most_steps;) {
    finite::NewtonStep step = finite::newton_step(*discrete, start, settings, follow);
    ++check.steps;
    check.factorisations += step.factorisations;
    check.status = step.status();
    if (check.status != contact::Status::solved) return check;
    const finite::StepTotals totals = totals_after(*discrete, step);
    linearise(*discrete, finite::next_state(*discrete, start, step));
    const std::vector<ModelQuantity> before = numbers;
    set_finite_values(totals, solution::largest_displacement(discrete->state.displacement), solution, numbers);
    check.is_stable = step.shift == 0;
    is_rough = !check.is_stable || step.is_too_long() || step.part.value_or(1.0) < 1 ||
               largest_change(before, numbers) > rough_change;
    start = std::move(step.next);
  }
  check.quantities = std::move(numbers);
  return check;
}

bool carry_to_finer_mesh(const solution::Summary& summary, ModelCheck& check) {
  if (check.status != contact::Status::solved) return false;
  std::vector<ModelQuantity> numbers = linear_numbers(summary);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const ModelQuantity& coarse = check.quantities[i];
    if (coarse.linear == 0 && numbers[i].linear != 0) return false;
    numbers[i].finite = coarse.linear == 0 ? coarse.finite : coarse.finite / coarse.linear * numbers[i].linear;
  }
  check.quantities = std::move(numbers);
  return true;
}

}  // namespace plastron::computation
