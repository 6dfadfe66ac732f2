// Imperfections of the mid-surface as shifts of a coarse mesh.
#pragma once
#include <plastron/mesh/coarse_mesh.hpp>
#include <plastron/mesh/surface_shift.hpp>
#include <plastron/problem/problem.hpp>

#include <memory>
#include <vector>

namespace plastron::meshing {

/// Returns the shifts for CoarseMesh::shifts. An expression is interpolated on each cell of a mesh in space. Throws
/// mesh::DomainError for a mode of another shell, for an expression that varies too fast for the cells, and for a displacement along
/// the normal where there are folds. `coarse` is the mesh without shifts.
std::vector<std::shared_ptr<const mesh::SurfaceShift>> shifts_of(const problem::Problem& problem,
                                                                 const mesh::CoarseMesh& coarse);

}  // namespace plastron::meshing
