// What supports carry: boundary by boundary, corner by corner, point by point. All together they carry Summary::support_reaction, but for
// what holds rigid bodies.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/certificate/wrench.hpp>

#include <string>
#include <vector>

namespace plastron::certificate {

/// Force [N] and couple [N m] of the supports at an owned node.
struct NodalSupportForce {
  std::size_t node = 0;
  Eigen::Matrix<double, 6, 1> force = Eigen::Matrix<double, 6, 1>::Zero();
};

struct SupportReaction {
  std::string boundary{};
  Wrench reaction{};       ///< on the shell, without what corners carry
  std::int64_t nodes = 0;  ///< that it holds
};

/// What edges carry at a corner beyond their line densities: see support_shares.hpp.
struct CornerReaction {
  std::vector<std::string> boundaries{};               ///< that meet there
  Eigen::Vector2d at = Eigen::Vector2d::Zero();        ///< in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the undeformed mid-surface [m]
  Wrench reaction{};                                   ///< on the shell
};

/// Held in three points against its six rigid motions, a shell under loads in equilibrium needs no force there; any other force at a point
/// is singular in this model (docs/model.md, section 6).
struct PointReaction {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< in Omega
  Vector3d force = Vector3d::Zero();  ///< on the shell; no edge that is held in its direction has part in it [N]
};

struct SupportReactions {
  std::vector<SupportReaction> boundaries{};  ///< one for every boundary that a support names, in the order of the case
  std::vector<CornerReaction> corners{};      ///< in an order of places
  std::vector<PointReaction> points{};        ///< in the order of the case
};

/// (collective)
SupportReactions support_reactions(const assembly::DiscreteShell& discrete,
                                   const std::vector<NodalSupportForce>& forces);

}  // namespace plastron::certificate
