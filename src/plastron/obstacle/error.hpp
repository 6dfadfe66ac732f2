// What is wrong with an obstacle, in words for who wrote it.
#pragma once
#include <stdexcept>

namespace plastron::obstacle {

/// A surface or raster that is none, or a point at which an obstacle has no distance.
struct ObstacleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace plastron::obstacle
