// Coarse meshes whose cells are divided into lattices of cells, each with its part of the exact map. A mesh sequence may
// cut a mesh along its chords, any number of times, without hanging nodes. The lattice of a cell of the first mesh then
// depends on its cuts alone and not on their order.
#pragma once
#include <plastron/fem/space.hpp>

#include <array>
#include <span>
#include <vector>

namespace plastron::fem {

/// Divides each quadrilateral into parts[c][0] x parts[c][1] cells along its own coordinates. Precondition:
/// neighbours have the same number along their common side.
mesh::CoarseMesh subdivided(const mesh::CoarseMesh& mesh, std::span<const std::array<int, 2>> parts);

/// Divides each quadrilateral at its cuts. Precondition: neighbours are cut at the same points of their common side.
mesh::CoarseMesh subdivided(const mesh::CoarseMesh& mesh, std::span<const mesh::Cuts> cuts);

/// Cuts each cell of the first mesh. The result stores the cuts (CoarseMesh::cuts). Precondition: are_conforming.
mesh::CoarseMesh cut_mesh(const mesh::CoarseMesh& first, std::vector<mesh::Cuts> cuts);

/// Whether cells with a common side are cut at the same points of it.
bool are_conforming(const mesh::CoarseMesh& mesh, std::span<const mesh::Cuts> cuts);

/// The place of a cut mesh's cell in a cell of the first mesh: xi_first = corner + size xi.
struct CutCell {
  std::size_t first;
  Vector2d corner, size;
};
/// Returns all cells in the order of cut_mesh(): by cell of the first mesh, xi_1 fastest. A mesh without cuts gives
/// its own cells.
std::vector<CutCell> cut_cells(const mesh::CoarseMesh& mesh);

/// Combines the cuts of the first mesh's cells with `cuts`, given for each cell of the present mesh in its own
/// coordinates.
std::vector<mesh::Cuts> with_cuts(const mesh::CoarseMesh& present, std::span<const mesh::Cuts> cuts);

/// Interpolates a field (values per node) from one cut of a mesh on another. Neither may have divided cells
/// (collective).
algebra::Vector interpolated(const algebra::Vector& field, const Space& before, const Space& after);

}  // namespace plastron::fem
