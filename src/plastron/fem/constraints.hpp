// Producers of constraints (constraints/map.hpp): what makes the values of one node follow from other nodes. Each function
// adds its rows to the maps of a space: `continuity` of every field, and `constraints` of (u, r).
#pragma once
#include <plastron/fem/surface.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace plastron::fem {

/// A hanging node with its masters, which may hang too, on the side of a still larger cell.
struct HangingNode {
  algebra::GlobalIndex node = 0;
  std::vector<std::pair<algebra::GlobalIndex, double>> masters{};  ///< at most degree + 1
};
/// Constrains the hanging nodes of a space that has no constraints yet (collective). `owned`: all hanging nodes that
/// this rank owns. Adds missing masters to the layout as ghosts.
void constrain_hanging_nodes(Space& space, const std::vector<HangingNode>& owned);

/// Two boundaries of the mesh that coincide in space and are joined. A rectangle is closed to a tube this way, and
/// pieces with separate charts form one shell.
struct Join {
  std::array<std::string, 2> boundaries;
  bool is_hinge = false;  ///< each side has a rotation of its own
  double stiffness = 0;   ///< of the hinge: moment per length and angle [N]
};
/// Returns the space in which the nodes on joined edges equal one node of each place (collective). Throws
/// DomainError on all ranks if a boundary does not exist, if a node has no partner at the same place, or if normals
/// are opposite.
///
/// Shells that meet at an angle (a kink) share the displacement of the edge and one rotation vector omega, r_i = omega
/// x a_3i. A shell's rotation does not contain the part of omega along its own normal. Therefore two shells share only
/// omega . t, t the edge's tangent:
///   u_2 = u_1,   r_2 . (t x a_32) = r_1 . (t x a_31).
/// The node of the second shell follows from the node of the first and keeps r_2 . t as its own coordinate. At a hinge it
/// keeps all of r_2, also where the normals are equal.
std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins);

/// Returns the space in which bodies carry the nodes of their boundaries (collective). Throws DomainError on all
/// ranks if a boundary does not exist, if two bodies carry one node, and if a hinge can turn freely about the line of
/// its nodes.
std::shared_ptr<const Space> with_rigid_bodies(std::shared_ptr<const Space> space, const Surface& surface,
                                               const std::vector<RigidBody>& bodies);

/// Returns the space whose rigid bodies have a part of the prescribed motions.
std::shared_ptr<const Space> with_part_of_motions(std::shared_ptr<const Space> space,
                                                  const std::function<double(const RigidBody&)>& part);

/// Returns the space for small motions about a deformed state, in which kinks and rigid bodies have turned (collective).
/// `normals`, `directors`: those of local nodes before and now. `places`: those of the bodies, whose prescribed
/// components become what remains to be moved.
std::shared_ptr<const Space> turned(const std::shared_ptr<const Space>& space, std::span<const Eigen::Vector3d> normals,
                                    std::span<const Eigen::Vector3d> directors, std::span<const BodyPlace> places);

/// Returns the place to which the fields (u, r) = y have moved a body (collective).
BodyPlace place_of(const Space& space, const PlacedBody& body, const algebra::Vector& y);
/// Returns a body for small motions about its place. Its prescribed components are what remains to be moved.
PlacedBody turned_body(PlacedBody body, const BodyPlace& place);

/// d [m] and theta [rad].
struct BodyMotion {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
};
/// Returns the motion nearest to the displacements of the body's nodes; parts that these do not show are 0 (collective).
BodyMotion fitted_motion(const Space& space, const PlacedBody& body, const algebra::Vector& y);
/// Returns the same with prescribed components unchanged (collective).
BodyMotion motion_of(const Space& space, const PlacedBody& body, const algebra::Vector& y);
/// Adds nodal forces on owned nodes that do the work of the body's force and moment in each of its motions. Among all
/// such forces they are the smallest.
void add_body_load(const Space& space, const PlacedBody& body, algebra::Vector& f);

}  // namespace plastron::fem
