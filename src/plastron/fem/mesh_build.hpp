// From what a mesh file says to a coarse mesh: cells with exact maps, named regions and boundaries, all examined.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>
#include <plastron/fem/mesh_data.hpp>

namespace plastron::fem {

/// Throws DomainError for elements of other kinds than `shape` allows, and for whatever is no mesh of the plane.
CoarseMesh build_coarse_mesh(const MeshData& data, Shape shape);

}  // namespace plastron::fem
