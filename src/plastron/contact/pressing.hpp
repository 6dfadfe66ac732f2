// Bounds, and given forces that move them: whether bounds fit, bounds at given positions, the unknowns that carry a
// force, and its first contacts. The program is described in problem.hpp and docs/methods/pressing-obstacles.md.
#pragma once
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace plastron::contact {

/// Asserts that load and bounds fit the matrix in layout, block and size, that forces are positive, and that shapes fit
/// the load, are finite and are zero on prescribed unknowns. It does not check the values of bounds.
void assert_fits_together(const BoxProblem& problem);

/// Whether lower <= upper everywhere, on all ranks, and no bound is NaN. Bounds that pressing forces move against each
/// other are not checked: their positions determine whether they cross (bounds_cross).
bool bounds_are_consistent(const BoxProblem& problem);

/// Returns the problem with its bounds at these positions and without pressing forces: a box.
BoxProblem at_positions(const BoxProblem& problem, std::span<const double> positions);
/// Moves the bounds of `box`, made by at_positions(), to other positions.
void move_bounds(const BoxProblem& problem, std::span<const double> positions, BoxProblem& box);

/// Whether some lower bound is above its upper bound by more than noise. (collective)
bool bounds_cross(const BoxProblem& box, const algebra::Vector& noise);

/// Returns the rate at which the active bound of an owned unknown moves with position k; 0 where the unknown is free.
double shape_at(const PressingForce& pressing, std::size_t i, Activity activity);
/// Returns the shape of force k where `set` fixes the unknown, zero elsewhere.
algebra::Vector active_shape(const PressingForce& pressing, const ActiveSet& set);
/// Whether some active unknown helps to carry the force. (collective)
bool is_carried(const PressingForce& pressing, const ActiveSet& set);

/// Returns R_k = sum of multiplier_i shape_ki over active i: the reaction of the structure to force k. (collective)
std::vector<double> reactions(const BoxProblem& problem, const algebra::Vector& multiplier, const ActiveSet& set);
/// Returns the sum of |multiplier_i shape_ki|, which determines the rounding of R_k. (collective)
std::vector<double> reaction_sizes(const BoxProblem& problem, const algebra::Vector& multiplier, const ActiveSet& set);
/// Returns sum_k F_k delta_k.
double work_of_forces(const BoxProblem& problem, std::span<const double> positions);

/// Whether each force presses some bound on its unknown: a lower bound that rises with delta, or an upper one that
/// falls. Otherwise nothing can ever carry the force. (collective)
bool every_force_can_be_carried(const BoxProblem& problem);

/// Sets positions[k] to the smallest value at which force k moves some bound exactly to z, with the other positions
/// fixed. Returns the owned unknowns with such bounds, all within noise(i). Precondition: the force can be carried.
/// (collective)
std::vector<Touch> touch(const BoxProblem& problem, std::size_t k, const algebra::Vector& z,
                         const std::function<double(std::size_t)>& noise, std::vector<double>& positions);

/// Two bounds of an unknown with distance `width`. It decreases by closing_k for each unit of position k.
struct Wedge {
  std::vector<double> closing{};
  double width = 0;
};
/// Returns the first bounds to cross on the way to positions + direction. Their width there is not greater than 0.
/// Nothing if no bounds cross. (collective)
std::optional<Wedge> first_wedge(const BoxProblem& problem, std::span<const double> positions,
                                 std::span<const double> direction);

}  // namespace plastron::contact
