// Conversion of a mesh file's data to a coarse mesh: cells with exact maps, named regions and boundaries, all
// checked.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>
#include <plastron/fem/mesh_data.hpp>

namespace plastron::fem {

/// Builds the coarse mesh. Throws DomainError for elements that `shape` does not allow, and for data that is no mesh
/// of the plane.
CoarseMesh build_coarse_mesh(const MeshData& data, Shape shape);

}  // namespace plastron::fem
