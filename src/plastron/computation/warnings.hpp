// Warnings about a problem or a result: where the linear model, the mesh or the contact search reaches its limits, and why
// there is no solution. Each is a text for the user.
#pragma once
#include <plastron/assembly/supports.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Returns one warning, in words for the user, if the finest mesh of a problem is so coarse that its elements lock.
/// Empty with tying. Each rank checks the whole problem. Precondition: a regular chart and a positive thickness.
std::vector<std::string> locking_warnings(const problem::Problem& problem);

/// Returns warnings on loads, rotations, stability, mesh, contact, supports and probes; needs contact zones and the stress peak.
std::vector<std::string> state_warnings(const problem::Problem& problem, const Result& result);
/// Returns warnings on strains beyond the linear law and on transverse shear that no shell has; needs modes and the stress peak.
std::vector<std::string> material_warnings(const problem::Problem& problem, const Result& result);

/// Returns the obstacles whose bounds contradict each other or a support, with the place where most room is missing; empty if
/// none do (collective).
std::string contradiction_text(const assembly::DiscreteShell& discrete);

/// Names the motion of least stiffness at a state of a shell with finite rotations that is no equilibrium, and the place that it
/// moves most; empty if it is not found (collective).
std::string softest_motion_text(const assembly::DiscreteShell& discrete, const solution::NodalSolution& nodal);

}  // namespace plastron::computation
