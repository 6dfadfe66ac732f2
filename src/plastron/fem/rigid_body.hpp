// Rigid bodies that carry edges of the shell.
#pragma once
#include <plastron/constraints/map.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plastron::fem {

using constraints::Matrix6;

/// At each node of its edges u = d + theta x (phi - reference) and r = theta x a_3, a motion without strain. Each of the
/// six numbers (d, theta) is an unknown of the system or prescribed.
struct RigidBody {
  std::string name{};
  std::vector<std::string> boundaries{};                ///< boundaries whose nodes it carries
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< reference point [m]
  bool turns_normals = true;                            ///< false: a hinge; r stays free in the shell
  std::array<std::optional<double>, 6> fixed{};         ///< prescribed components of d [m], then theta [rad]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< force at the reference point [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();     ///< moment about the reference point [N m]
  int factor = -1;  ///< place of its own factor in a list of factors; -1: it has none

  bool operator==(const RigidBody& other) const = default;

  /// Returns theta, with 0 for components that are free [rad].
  Eigen::Vector3d prescribed_rotation() const {
    return {fixed[3].value_or(0), fixed[4].value_or(0), fixed[5].value_or(0)};
  }
};

/// The place to which a body has moved: q = reference + displacement + turn (p - reference).
struct BodyPlace {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

/// A node of a body.
struct BodyNode {
  algebra::LocalIndex node = 0;
  Matrix6 motion = Matrix6::Zero();  ///< W: its (u, r) for (d, length theta)
};

/// Returns the vector v of a block W = -[v]x of a body's motion (with theta x v = -[v]x theta).
inline Eigen::Vector3d turned_vector(const Eigen::Ref<const Eigen::Matrix3d>& block) {
  return {block(1, 2), block(2, 0), block(0, 1)};
}

/// A rigid body on one mesh. Its six motions are stored at two of its nodes, the hosts: the displacement of the first
/// host is d, of the second host length theta.
struct PlacedBody {
  RigidBody body{};
  std::array<algebra::LocalIndex, 2> hosts{-1, -1};  ///< local numbers; -1 where this rank has no node of the body
  double length = 1;                                 ///< from the reference point to the farthest node [m]
  Matrix6 gram = Matrix6::Zero();                    ///< sum over its nodes of W' D W, with D = diag(1, length^2)
  std::vector<BodyNode> members{};                   ///< its local nodes, ascending

  const BodyNode* find(algebra::LocalIndex node) const {
    const auto found = std::ranges::lower_bound(members, node, {}, &BodyNode::node);
    return found != members.end() && found->node == node ? &*found : nullptr;
  }
};

}  // namespace plastron::fem
