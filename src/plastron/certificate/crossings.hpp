// Proves that no obstacle passes through the shell on its path between two states (M36).
//
// A ball of radius D fits into the obstacle (core_depth.hpp). To pass, its centre must cross the mid-surface, at a point
// where the distance is -D. So the distance d of the points of the mid-surface stays above -D on the path, or the
// obstacle may have passed. Neither time nor place is sampled: d changes by at most the distance between two points, and in
// time by at most their relative speed (conservative advancement).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <vector>

namespace plastron::certificate {

/// A state on the path of the shell. It moves straight from one to the next, and obstacles move as the case says.
struct Station {
  algebra::Vector displacement{};   ///< (u, r) with current ghosts; without a layout the shell is undeformed
  double time = 0;                  ///< time of moving obstacles
  std::vector<double> positions{};  ///< positions of pressed obstacles; empty: 0 [m]
};

/// A place of an owned cell where an obstacle may pass through the shell.
struct Crossing {
  std::size_t cell, obstacle;
  Eigen::Vector2d x;  ///< place, parameters in Omega
  double part;        ///< part of the path between the stations
};

/// Returns a place for each owned cell and obstacle that may pass through it; empty if none does. Points that lie in an obstacle
/// when the shell is undeformed are left out: nothing shows from which side they come. Throws ObstacleError on this rank
/// alone.
std::vector<Crossing> crossings(const assembly::DiscreteShell& discrete, const Station& from, const Station& to);

}  // namespace plastron::certificate
