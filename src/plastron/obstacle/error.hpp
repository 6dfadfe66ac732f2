// Errors of obstacles, in words for the author of the case.
#pragma once
#include <stdexcept>

namespace plastron::obstacle {

/// An invalid surface or raster, or a point at which an obstacle has no distance.
struct ObstacleError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace plastron::obstacle
