// A coarse mesh cut along its chords, again and again, without hanging nodes: every cell of the first mesh is a lattice of cells, whatever was
// cut in which order, and its cuts alone say which.
#pragma once
#include <plastron/fem/space.hpp>

#include <span>
#include <vector>

namespace plastron::fem {

/// Each cell of the first mesh at its cuts, which it keeps (CoarseMesh::cuts). Precondition: are_conforming.
CoarseMesh cut_mesh(const CoarseMesh& first, std::vector<Cuts> cuts);

/// Whether cells that have a side in common are cut at the same points of it.
bool are_conforming(const CoarseMesh& mesh, std::span<const Cuts> cuts);

/// What a cell of a cut mesh is of a cell of the first one: xi_first = corner + size xi.
struct CutCell {
  std::size_t first;
  Vector2d corner, size;
};
/// All cells, as cut_mesh() orders them: those of the first mesh's first cell first, xi_1 fastest. Each is itself where nothing was cut.
std::vector<CutCell> cut_cells(const CoarseMesh& mesh);

/// The cuts that the first mesh's cells have, and those given for each cell of the present mesh in its own coordinates.
std::vector<Cuts> with_cuts(const CoarseMesh& present, std::span<const Cuts> cuts);

/// The interpolant of a field (values per node) of one cutting of a mesh on another one. Both without divided cells (collective).
algebra::Vector interpolated(const algebra::Vector& field, const Space& before, const Space& after);

}  // namespace plastron::fem
