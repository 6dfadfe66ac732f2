// The nodes of a shell with finite rotations (M23) at a state: y = phi + u, d = a_3 + r, |d| = |a_3|. That is 1 on charts; the
// directors of meshes in space are polynomials, of length 1 only at the nodes of the file. The unknowns are those of the
// linear model, (u, r). Supports and motions are those of increments from the state.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/nodal_geometry.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace plastron::assembly {

/// Returns the places of the rigid bodies that are nearest to the places of their nodes (collective).
std::vector<fem::BodyPlace> body_places(const fem::Space& space, const algebra::Vector& y);

/// Returns (u, r) with directors of their lengths in the reference at all nodes except hanging ones, which are interpolated. Kinks
/// keep their angle. Rigid bodies take their nodes to their places (collective).
algebra::Vector with_kept_lengths(const fem::Space& space, const std::vector<NodalPoint>& points, algebra::Vector y);

/// Returns the nodal points in their deformed places, with directors as normals. Weights are those of the reference.
std::vector<NodalPoint> moved_points(std::vector<NodalPoint> points, const algebra::Vector& y);

/// Returns the space of small motions about the state, in which kinks and rigid bodies have turned (collective).
std::shared_ptr<const fem::Space> turned_space(const std::shared_ptr<const fem::Space>& space,
                                               const std::vector<NodalPoint>& points,
                                               const std::vector<NodalPoint>& moved,
                                               const std::vector<fem::BodyPlace>& places);

/// Returns a_3 + r where a support prescribes all three components of r.
std::optional<Vector3d> prescribed_director(const Vector3d& a3, const NodeSupport& support);

/// Returns the supports of increments: prescribed values less the present ones. `supports`: those of node_supports().
std::vector<NodeSupport> remaining_supports(std::vector<NodeSupport> supports, const std::vector<NodalPoint>& points,
                                            const algebra::Vector& y);

/// Moves the loads on rigid bodies with them, from `space` to `turned`: dead forces, and moments about the reference points.
void turn_body_loads(const fem::Space& space, const fem::Space& turned, const energy::Factors& factors,
                     algebra::Vector& load);

}  // namespace plastron::assembly
