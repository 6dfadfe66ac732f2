// The mid-surface of a mesh in space: on each cell of the file a polynomial for phi and one of the same order for the
// director, which is continuous across cells that meet smoothly. Strains read the director in the place of a_3 and its
// derivatives in the place of d_a a_3. A rigid motion u = c + w x phi, r = w x d then has no strain, whatever the
// director (docs/methods/surface-meshes.md).
#pragma once
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <cstdint>
#include <vector>

namespace plastron::mesh {

struct SurfacePatches {
  struct Patch {
    int order = 1;
    std::vector<std::int32_t> nodes{};  ///< on lattice(shape, order), xi_1 fastest
  };

  Shape shape = Shape::quadrilateral;
  std::vector<geometry::Vector3d> positions{};  ///< of nodes; along folds each side has its own [m]
  std::vector<geometry::Vector3d> directors{};  ///< unit vectors at the nodes
  std::vector<Patch> patches{};
  /// Directions of the first axis of results: the coordinate axis along which the surface is longest, and the next
  /// one, for places where the first is nearly normal to the surface.
  std::array<geometry::Vector3d, 2> axes{geometry::Vector3d::UnitX(), geometry::Vector3d::UnitY()};

  /// Returns the frame at a point of a patch in the coordinates of `at`, a map into the patch's reference cell.
  geometry::Frame frame(int patch, const PlaneJet& at) const;
  /// Returns the axis of results in the tangent plane.
  geometry::Vector3d first_tangent(const geometry::Frame& frame) const;
};

/// Sets SurfacePatches::axes from the extent of the nodes.
void choose_axes(SurfacePatches& surface);

}  // namespace plastron::mesh
