// Radius of a ball inside of an obstacle: the whole obstacle passes through a surface only if the centre of this ball does.
#pragma once
#include <plastron/obstacle/obstacle.hpp>

namespace plastron::certificate {

using geometry::Vector3d;

/// Whether the obstacle has a far side. Half-spaces, bodies below a graph, infinite cones and complements of bodies have none:
/// no shell can come behind them.
bool has_far_side(const obstacle::Obstacle& obstacle);

/// Returns the radius of a ball inside of the obstacle, if possible `wanted` [m]. `near`: the distance at X. Bodies without a
/// formula are measured behind the surface point nearest to X; each counts as one connected body. Throws
/// ObstacleError.
double core_depth(const obstacle::Obstacle& obstacle, const Vector3d& X, const obstacle::Nearest& near, double wanted);

}  // namespace plastron::certificate
