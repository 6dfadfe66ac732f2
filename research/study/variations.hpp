// A problem with one thing changed.
#pragma once
#include <research/study/kinds.hpp>

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

/// A support prescribes something other than zero, at some place.
bool has_prescribed_motion(const problem::Problem& problem);

}  // namespace plastron::study
