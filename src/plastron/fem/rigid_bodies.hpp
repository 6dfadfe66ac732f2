// Rigid bodies that carry edges of the shell: at each node of theirs u = d + theta x (phi - reference) and r = theta x a_3, the
// motion that strains nothing. The six numbers (d, theta) are unknowns of the system or prescribed one by one.
#pragma once
#include <plastron/fem/surface.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plastron::fem {

struct RigidBody {
  std::string name{};
  std::vector<std::string> boundaries{};                ///< whose nodes it carries
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< [m]
  bool turns_normals = true;                            ///< false: a hinge, r is left to the shell
  std::array<std::optional<double>, 6> fixed{};         ///< d [m], then theta [rad], where they are prescribed
  Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< at the reference point [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();     ///< about it [N m]
};

/// d [m] and theta [rad].
struct BodyMotion {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
};

struct PlacedBody;

/// The space with the nodes of the bodies' boundaries carried by them (collective). Throws DomainError on all ranks where a boundary is
/// not there, where two bodies carry one node, and where a hinge is free to turn about the line of its nodes.
std::shared_ptr<const Space> with_rigid_bodies(std::shared_ptr<const Space> space, const Surface& surface,
                                               const std::vector<RigidBody>& bodies);

/// The motion that is nearest to what the body's nodes do; prescribed components are as prescribed (collective).
BodyMotion motion_of(const Space& space, const PlacedBody& body, const algebra::Vector& y);

/// Adds the least nodal forces on owned nodes that do the work of the body's force and moment in every motion of it.
void add_body_load(const Space& space, const PlacedBody& body, algebra::Vector& f);

}  // namespace plastron::fem
