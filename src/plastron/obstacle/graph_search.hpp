// Where on a graph z = h there may be a point nearer to X than one that is known.
#pragma once
#include <plastron/obstacle/graph_samples.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <vector>

namespace plastron::obstacle {

/// To begin a descent of the distance at.
struct GraphStart {
  double least;  ///< what half the squared distance may fall to there
  Eigen::Vector2d p;
  double spacing;  ///< of the samples around it: a foot this near is the same one
};

struct GraphStarts {
  std::vector<GraphStart> starts{};  ///< the most promising first
  double missed =
      0;  ///< spacing of the finest samples, where these miss waves of the graph and the search ends; else 0
};

/// Bound for all points within `reach` of X. The graph is sampled at least 8 times within the reach
/// and up to 128 times where it changes its curvature from sample to sample.
GraphStarts starts_nearer_than(double reach, const Vector3d& X, GraphSamples& samples);

}  // namespace plastron::obstacle
