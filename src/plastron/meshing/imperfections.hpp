// Imperfections of the mid-surface as shifts of a coarse mesh.
#pragma once
#include <plastron/mesh/coarse_mesh.hpp>
#include <plastron/mesh/surface_shift.hpp>
#include <plastron/problem/problem.hpp>

#include <memory>
#include <vector>

namespace plastron::meshing {

/// Returns the shifts for CoarseMesh::shifts. An expression is interpolated on each cell of a mesh in space. Throws
/// mesh::DomainError if a mode has no value on some cell.
std::vector<std::shared_ptr<const mesh::SurfaceShift>> shifts_of(
    const std::vector<problem::Imperfection>& imperfections, const mesh::CoarseMesh& coarse);

}  // namespace plastron::meshing
