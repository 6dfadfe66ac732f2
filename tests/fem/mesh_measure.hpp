// Properties of every mesh: its area, the lengths of its boundaries, and that its cells fit together.
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <map>
#include <string>

namespace plastron::fem {

/// Area of Omega by quadrature over the exact maps.
double area(const mesh::CoarseMesh& mesh);
/// Area of the owned cells of one rank.
double owned_area(const Space& space);
/// Length of every named boundary that lies in owned cells of one rank; "" for the unnamed rest.
std::map<std::string, double> owned_boundary_lengths(const Space& space);
/// The point of Omega at xi in a cell.
Vector2d position(const Space& space, const Cell& cell, const Vector2d& xi);

/// Expects that vertices are the images of the reference cell's corners, that maps keep the orientation, that neighbours
/// meet in the same points all along their common side, and that named edges are sides of cells.
void expect_cells_fit(const mesh::CoarseMesh& mesh);

}  // namespace plastron::fem
