// A problem with one thing changed.
#pragma once
#include <plastron/problem/problem.hpp>
#include <research/study/report.hpp>

#include <string>
#include <vector>

namespace plastron::study {

/// e times `factor`; chart, obstacle and loads stay. The touching face moves with e/2.
problem::Problem with_thickness_scaled(problem::Problem problem, double factor);
/// The problem at each factor but 1, where it is the case itself.
std::vector<Variant> thickness_variants(const problem::Problem& problem, const std::vector<double>& factors);
/// The surface of a half-space moves towards the shell: every gap is smaller by `height` [m].
void raise(obstacle::Obstacle& half_space, double height);
/// All loads of (M9) times `factor`.
problem::Problem with_loads_scaled(problem::Problem problem, double factor);
/// Supports hold the same components at zero, and there is no obstacle: the linear problem on V.
problem::Problem linear_and_homogeneous(problem::Problem problem);
/// The problem on uniform meshes, for studies that compare these. A case that leaves meshes to its accuracy gets the default
/// number of refinements.
problem::Problem on_uniform_meshes(problem::Problem problem);

problem::Problem in_formulation(problem::Problem problem, element::Formulation formulation);
/// Why `run` would refuse the problem in this formulation; empty if it would not.
std::string refusal(const problem::Problem& problem, element::Formulation formulation);

/// A support prescribes something other than zero, at some place.
bool has_prescribed_motion(const problem::Problem& problem);

}  // namespace plastron::study
