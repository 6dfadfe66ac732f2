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

/// Warns where the model of finite rotations has other numbers or no stable solution nearby, or where the shell would
/// buckle.
std::vector<std::string> linear_model_warnings(const Result& result);
/// Returns a warning if the loads do not move the displacement that is to control them.
std::vector<std::string> control_warnings(const Result& result);
/// Returns warnings on snaps between states with finite rotations. Where the program has divided the way, more parts do not help.
std::vector<std::string> jump_warnings(const problem::Problem& problem, const Result& result);
/// Returns warnings on equilibria with finite rotations that are nearly critical, or stable only because of weak contact.
std::vector<std::string> stability_warnings(const Result& result);

/// Returns a part as per cent, as long as this is meaningful.
std::string percent(double part);

/// Returns a warning if the strains at the first buckling load are too large for a linear law: such modes are as short as the
/// cells.
std::vector<std::string> mode_warnings(const Result& result);

/// Warns of loads whose expressions are 0 at all points of the mesh.
std::vector<std::string> load_warnings(const problem::Problem& problem, const Result& result);
/// Warns of strains beyond the range of the linear material law; needs the stress peak.
std::vector<std::string> strain_warnings(const Result& result);
/// Warns of a share of transverse shear that no shell has.
std::vector<std::string> shear_warnings(const Result& result);

/// Warns if the mesh of the file causes larger errors than asked for or than the discretisation.
std::vector<std::string> geometry_warnings(const Result& result);

/// Warns of nodes that were deep inside an obstacle and were pushed out along the shell instead of across it. Their
/// nearest surface at the start may have been the wrong one.
std::vector<std::string> sideways_warnings(const solution::Summary& summary);

/// Warns of rigid bodies that move their nodes into obstacles.
std::vector<std::string> body_warnings(const solution::Summary& summary);

/// Warns of penetration between nodes, lifts that change much of the energy, reactions concentrated on edges, and
/// tolerances that rounding has loosened.
std::vector<std::string> contact_warnings(const Result& result, const contact::Settings& asked);

/// Forces that supports carry at points: a shell fixed at three points against its rigid motions needs none if its loads
/// are in equilibrium. A remaining force has no limit as the mesh is refined (docs/model.md, section 6).
/// Returns one warning for the point with the largest reaction, if this is above a millionth of the loads.
std::vector<std::string> point_support_warnings(const Result& result, const std::vector<assembly::Support>& supports);
/// Returns one warning for each probe at a place where stresses have no limit or a peak.
std::vector<std::string> probe_warnings(const Result& result);

/// Returns the obstacles whose bounds contradict each other or a support, with the place where most room is missing; empty if
/// none do (collective).
std::string contradiction_text(const assembly::DiscreteShell& discrete);

/// Names the motion of least stiffness at a state of a shell with finite rotations that is no equilibrium, and the place that it
/// moves most; empty if it is not found (collective).
std::string softest_motion_text(const assembly::DiscreteShell& discrete, const solution::NodalSolution& nodal);

}  // namespace plastron::computation
