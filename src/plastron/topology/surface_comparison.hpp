// A second surface of the cells of a mesh in space. Results on both surfaces tell the error of the mesh against the part
// that it describes (docs/methods/surface-meshes.md).
//
// Cells of order 1 and 2 are fitted to their neighbours: heights over a plane by a polynomial of higher degree through the
// nodes of a cell and of the cells around it. On a smooth part this polynomial is nearer to the part than the cell. Cells
// of a higher order are compared with the polynomial of one order less in the same cell; the error decays from order to
// order.
#pragma once
#include <plastron/mesh/coarse_mesh.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <memory>
#include <string>
#include <vector>

namespace plastron::topology {

struct SurfaceComparison {
  std::shared_ptr<const mesh::SurfacePatches> patches{};  ///< the second surface
  double decay = 1;                                       ///< error of a result on the mesh over its difference
  double deviation = 0;                                   ///< estimated distance of the mesh from the part [m]
  geometry::Vector3d place{geometry::Vector3d::Zero()};   ///< where it is largest [m]
  double judged_share = 1;  ///< share of the area where a fit is possible; elsewhere both surfaces are equal
};

/// Returns the second surface of a coarse mesh that is not cut. Folds keep their nodes and directors. Directors on the
/// boundaries `symmetric` stay in their planes. Precondition: mesh.patches.
SurfaceComparison compared_surface(const mesh::CoarseMesh& mesh, const std::vector<std::string>& symmetric);

}  // namespace plastron::topology
