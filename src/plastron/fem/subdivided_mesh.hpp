// Coarse cells divided into lattices of cells, each with its part of the exact map.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <array>
#include <span>

namespace plastron::fem {

/// Divides each quadrilateral into parts[c][0] x parts[c][1] cells along its own coordinates. Precondition:
/// neighbours have the same number along their common side.
CoarseMesh subdivided(const CoarseMesh& mesh, std::span<const std::array<int, 2>> parts);

/// Divides each quadrilateral at its cuts. Precondition: neighbours are cut at the same points of their common side.
CoarseMesh subdivided(const CoarseMesh& mesh, std::span<const Cuts> cuts);

}  // namespace plastron::fem
