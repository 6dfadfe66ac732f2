// What supports at points carry. Held in three points against its six rigid motions, a shell under loads in equilibrium
// needs no force there; any other force at a point is singular in this model (docs/model.md, section 6).
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <map>
#include <utility>
#include <vector>

namespace plastron::certificate {

using geometry::Vector3d;

struct PointReaction {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< in Omega
  Vector3d force = Vector3d::Zero();             ///< of all supports of its node on the shell [N]
};

/// The owned nodes that supports hold as points, each with its place in DiscreteShell::support_points().
std::vector<std::pair<std::size_t, std::size_t>> point_nodes(const assembly::DiscreteShell& discrete);

/// Of every support point, from the forces [N] at the owned nodes (collective).
std::vector<PointReaction> point_reactions(const assembly::DiscreteShell& discrete,
                                           const std::map<std::size_t, Vector3d>& at_nodes);

/// Sum of the norms of the nodal loads, couples over the length `size` [N] (collective).
double load_norms(const assembly::DiscreteShell& discrete, double size);

}  // namespace plastron::certificate
