// The primal-dual active set method: a semismooth Newton method for the box-constrained quadratic program. Each step
// solves on the subproblem of the present active set, then moves every unknown that breaks a condition to the other side at
// once:
//   active   <-  free and beyond its bound
//   free     <-  active with a multiplier of the wrong sign
// Fast when it starts near the solution's active set, but in general nothing forbids it to come back to a set it has
// seen. Source: Hintermueller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton method (2003).
//
// A set that leaves a motion free has no solution: then proximal points go on (proximal_point.hpp), where there are neither equations nor
// pressing forces; with these the start is what touches at z = 0, or all bounds.
//
// Every set seen is remembered by its fingerprint. When one comes back, or when the number of changes has not fallen
// for long, the projected search (projected_search.hpp) takes over, which cannot cycle; with equations, the dual ascent
// (dual_ascent.hpp) with the projected search inside. Pressing forces: the subproblems have a border (pressed_subproblem.hpp), and the
// safeguard is the pressing search (pressing_search.hpp) with this method inside; with equations it is that search from the start.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// `initial` is the active set to start from (owned unknowns; empty: nothing active). `preconditioner` must belong to problem.matrix. (collective)
BoxSolution solve_primal_dual_active_set(const BoxProblem& problem, std::span<const Activity> initial,
                                         algebra::Preconditioner& preconditioner, const Settings& settings = {},
                                         const Observer& observer = {});

}  // namespace plastron::contact
