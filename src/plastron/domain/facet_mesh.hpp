// Meshes in space of facets: .stl, .obj and .ply files. Their triangles are remeshed.
#pragma once
#include <plastron/domain/domain.hpp>
#include <plastron/domain/mesh_data.hpp>

namespace plastron::domain {

/// A mesh and how it is read. Its lengths are those of the case. What is a fold is known from the facets: folds are named
/// curves, and cells meet smoothly elsewhere at any angle.
struct FacetMesh {
  MeshData data{};
  SpaceReading reading{};
};

/// Reads facets and meshes them with quadrilaterals, or with triangles, with sides of about `reading.size`; if it is not given, of
/// about `part` of the usual size, or with those of the facets themselves if `part` is 0. Smooth faces
/// are regions with the name of their solid or group in the file, or "surface 1", ...; the curves between them are "edge 1",
/// ... (facets/facets.hpp). Throws DomainError.
FacetMesh mesh_facets(const std::string& path, const SpaceReading& reading, mesh::Shape shape, double part = 1);

}  // namespace plastron::domain
