// Bounds that given forces move: where they are at given positions, what carries a force, what it meets first. The program is told in
// problem.hpp and docs/methods/pressing-obstacles.md; its solvers are pressed_subproblem.hpp and pressing_search.hpp.
#pragma once
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/subproblem_point.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace plastron::contact {

/// Asserts that forces are positive and shapes fit the load, finite and zero on prescribed unknowns.
void assert_pressing_fits(const BoxProblem& problem);

/// The problem with its bounds at these positions, and with no pressing forces: a box.
BoxProblem at_positions(const BoxProblem& problem, std::span<const double> positions);
/// The bounds of `box`, made by at_positions(), at other positions.
void move_bounds(const BoxProblem& problem, std::span<const double> positions, BoxProblem& box);

/// Whether some lower bound is above its upper bound by more than noise. (collective)
bool bounds_cross(const BoxProblem& box, const algebra::Vector& noise);
/// Whether positions change the width upper_i - lower_i of an owned unknown.
bool moves_apart_or_together(const BoxProblem& problem, std::size_t i);

/// How fast the bound at which an owned unknown stands moves with position k; 0 where it is free.
double shape_at(const PressingForce& pressing, std::size_t i, Activity activity);
/// The shape of force k where `set` holds the unknown, zero elsewhere.
algebra::Vector held_shape(const PressingForce& pressing, const ActiveSet& set);
/// Whether some active unknown takes part in carrying the force. (collective)
bool is_met(const PressingForce& pressing, const ActiveSet& set);

/// R_k = sum of multiplier_i shape_ki over active i: what the structure answers to force k. (collective)
std::vector<double> reactions(const BoxProblem& problem, const algebra::Vector& multiplier, const ActiveSet& set);
/// The sum of |multiplier_i shape_ki|: of which R_k has its rounding. (collective)
std::vector<double> reaction_sizes(const BoxProblem& problem, const algebra::Vector& multiplier, const ActiveSet& set);
/// sum_k F_k delta_k
double work_of_forces(const BoxProblem& problem, std::span<const double> positions);

/// Whether each force presses some bound on its unknown: a lower bound that rises with delta, or an upper one that falls. Otherwise
/// nothing can ever carry it. (collective)
bool every_force_can_be_carried(const BoxProblem& problem);

/// Puts positions[k] to the smallest value at which force k presses some bound just onto z, the others staying; tells which owned unknowns
/// these are, all within noise(i) of it. The force can be carried. (collective)
std::vector<Touch> touch(const BoxProblem& problem, std::size_t k, const algebra::Vector& z,
                         const std::function<double(std::size_t)>& noise, std::vector<double>& positions);

/// Positions at which the two bounds of some unknown are `width` apart, falling by closing_k for each unit of position k.
struct Wedge {
  std::vector<double> closing{};
  double width = 0;
};
/// The first bounds to cross on the way to positions + direction, such as are no wider than 0 there; nothing if none do. (collective)
std::optional<Wedge> first_wedge(const BoxProblem& problem, std::span<const double> positions,
                                 std::span<const double> direction);

}  // namespace plastron::contact
