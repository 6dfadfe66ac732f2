// Reactions of supports per boundary, per corner and per point. Their sum is Summary::support_reaction without the
// reactions of rigid bodies.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/solution/wrench.hpp>

#include <string>
#include <vector>

namespace plastron::solution {

/// Force [N] and couple [N m] of the supports at an owned node.
struct NodalSupportForce {
  std::size_t node = 0;
  assembly::Vector6 force = assembly::Vector6::Zero();
};

struct SupportReaction {
  std::string boundary{};
  Wrench reaction{};       ///< reaction on the shell, without the parts of corners
  std::int64_t nodes = 0;  ///< number of nodes that it supports
};

/// Reaction of edges at a corner beyond their line densities: see support_shares.hpp.
struct CornerReaction {
  std::vector<std::string> boundaries{};               ///< boundaries that meet there
  Eigen::Vector2d at = Eigen::Vector2d::Zero();        ///< in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the undeformed mid-surface [m]
  Wrench reaction{};                                   ///< reaction on the shell
};

/// Reaction at a supported point. A shell in equilibrium under its loads that three points support against its six
/// rigid motions needs no force there. Any other force at a point is singular in this model (docs/model.md, section
/// 6).
struct PointReaction {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< in Omega
  Vector3d position = Vector3d::Zero();          ///< on the mid-surface [m]
  Vector3d force = Vector3d::Zero();             ///< force on the shell, without directions that an edge fixes [N]
};

struct SupportReactions {
  std::vector<SupportReaction> boundaries{};  ///< one per boundary with a support, in the order of the case
  std::vector<CornerReaction> corners{};      ///< ordered by place
  std::vector<PointReaction> points{};        ///< in the order of the case
};

/// Computes the reactions from the nodal forces (collective).
SupportReactions support_reactions(const assembly::DiscreteShell& discrete,
                                   const std::vector<NodalSupportForce>& forces);

}  // namespace plastron::solution
