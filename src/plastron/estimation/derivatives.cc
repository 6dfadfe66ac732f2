#include <plastron/estimation/derivatives.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/estimation/point_values.hpp>
#include <plastron/estimation/reactions.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <algorithm>
#include <numeric>

namespace plastron::estimation {

namespace {

/// A derivative without loads.
Derivative zero(const Solved& solved) {
  const algebra::Vector none(solved.box.load.layout(), solved.box.load.block());
  return {.dual = {.load = none, .held = none}};
}

/// The energy 1/2 a(U, U): its own strain errors, and the reactions weighted with the values of fixed coordinates.
Derivative derivative_of(const Energy& /*energy*/, const Solved& solved) {
  Derivative result = zero(solved);
  result.value = solved.discrete.shell.energies(solved.nodal.y).total();
  for (std::size_t i = 0; i < solved.z.activity.size(); ++i)
    if (solved.z.activity[i] != contact::Activity::free) result.dual.held.owned()[i] = -solved.z.z.owned()[i];
  result.weighs_gaps = true;
  return result;
}

Derivative derivative_of(const LoadWork& /*work*/, const Solved& solved) {
  Derivative result = zero(solved);
  result.value = algebra::dot(solved.discrete.load, solved.nodal.y);
  result.dual.load = solved.box.load;
  return result;
}

Derivative derivative_of(const ContactArea& area, const Solved& solved) {
  Derivative result = zero(solved);
  const std::vector<double> areas = zones::contact_areas(solved.discrete, solved.nodal);
  result.value = area.obstacle ? areas[*area.obstacle] : std::accumulate(areas.begin(), areas.end(), 0.0);
  return result;
}

Derivative derivative_of(const ObstaclePosition& position, const Solved& solved) {
  Derivative result = zero(solved);
  result.value = solved.discrete.positions()[position.obstacle];
  const auto pressed = assembly::pressed_obstacles(solved.discrete);
  result.dual.positions.assign(pressed.size(), 0);
  const auto found = std::ranges::find(pressed, position.obstacle);
  if (found != pressed.end()) result.dual.positions[static_cast<std::size_t>(found - pressed.begin())] = 1;
  return result;
}

}  // namespace

const std::shared_ptr<const recovery::ResultantPatches>& Solved::recovered() const {
  if (!patches) patches = std::make_shared<const recovery::ResultantPatches>(discrete, nodal);
  return patches;
}

Derivative derivative(const Functional& functional, const Solved& solved) {
  return std::visit([&](const auto& f) { return derivative_of(f, solved); }, functional);
}

std::vector<double> values(std::span<const Goal> goals, const Solved& solved) {
  std::vector<double> result;
  for (const Goal& goal : goals) result.push_back(derivative(goal.functional, solved).value);
  return result;
}

}  // namespace plastron::estimation
