// Search for places on a graph z = h with a point nearer to X than a known one.
#pragma once
#include <plastron/obstacle/graph_samples.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <vector>

namespace plastron::obstacle {

/// Start of a descent of the distance.
struct GraphStart {
  double least;  ///< lower bound of half the squared distance there
  Eigen::Vector2d p;
  double spacing;  ///< spacing of the samples around it; feet within it are identical
};

struct GraphStarts {
  std::vector<GraphStart> starts{};  ///< most promising first
  double missed =
      0;  ///< spacing of the finest samples if they miss waves of the graph and the search therefore ends; else 0
};

/// Returns starts for all points within `reach` of X. The graph is sampled at least 8 times within the reach. Where
/// its curvature changes from sample to sample, it is sampled up to 128 times.
GraphStarts starts_nearer_than(double reach, const Vector3d& X, GraphSamples& samples);

}  // namespace plastron::obstacle
