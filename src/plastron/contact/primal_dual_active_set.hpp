// The primal-dual active set method: a semismooth Newton method for the box-constrained quadratic program. Each step
// solves on the subproblem of the present active set. Then it moves every unknown that violates a condition to the
// other set at once:
//   active   <-  free and beyond its bound
//   free     <-  active with a multiplier of the wrong sign
// It is fast when it starts near the solution's active set, but in general it may return to an earlier set.
// Source: Hintermueller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton method (2003).
//
// A set that leaves a motion free has no solution. Then proximal points continue (proximal_point.hpp), if there are
// neither equations nor pressing forces. With these, the method starts with the unknowns that touch at z = 0, or with
// all bounds active.
//
// The method remembers every set by its fingerprint. When a set occurs again, or when the number of changes has not
// decreased for many iterations, the projected search (projected_search.hpp) replaces it, which cannot cycle. With
// equations, this is the dual ascent (dual_ascent.hpp) with the projected search inside. With pressing forces, the
// subproblems have a border (pressed_subproblem.hpp), and the safeguard is the pressing search (pressing_search.hpp)
// with this method inside. With equations too, the pressing search is used from the start.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <span>

namespace plastron::contact {

/// Solves the problem. `initial` is the starting active set (owned unknowns; empty: nothing active). `preconditioner`
/// must belong to problem.matrix. (collective)
BoxSolution solve_primal_dual_active_set(const BoxProblem& problem, std::span<const Activity> initial,
                                         algebra::Preconditioner& preconditioner, const Settings& settings = {},
                                         const Observer& observer = {});

}  // namespace plastron::contact
