// Rigid bodies that carry edges of the shell. At each of their nodes u = d + theta x (phi - reference) and r = theta
// x a_3, a motion without strain. Each of the six numbers (d, theta) is an unknown of the system or prescribed.
#pragma once
#include <plastron/fem/surface.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plastron::fem {

struct RigidBody {
  std::string name{};
  std::vector<std::string> boundaries{};                ///< boundaries whose nodes it carries
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< reference point [m]
  bool turns_normals = true;                            ///< false: a hinge; r stays free in the shell
  std::array<std::optional<double>, 6> fixed{};         ///< prescribed components of d [m], then theta [rad]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< force at the reference point [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();     ///< moment about the reference point [N m]
};

/// d [m] and theta [rad].
struct BodyMotion {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
};

struct PlacedBody;

/// Returns the space in which bodies carry the nodes of their boundaries (collective). Throws DomainError on all
/// ranks if a boundary does not exist, if two bodies carry one node, and if a hinge can turn freely about the line of
/// its nodes.
std::shared_ptr<const Space> with_rigid_bodies(std::shared_ptr<const Space> space, const Surface& surface,
                                               const std::vector<RigidBody>& bodies);

/// Returns the motion nearest to the displacements of the body's nodes, with prescribed components unchanged
/// (collective).
BodyMotion motion_of(const Space& space, const PlacedBody& body, const algebra::Vector& y);

/// Adds nodal forces on owned nodes that do the work of the body's force and moment in each of its motions. Among all
/// such forces they are the smallest.
void add_body_load(const Space& space, const PlacedBody& body, algebra::Vector& f);

}  // namespace plastron::fem
