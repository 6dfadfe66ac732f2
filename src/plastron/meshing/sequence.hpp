// The sequence of meshes of a problem: its start mesh, with joined edges and rigid bodies on every level.
#pragma once
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/problem/problem.hpp>

#include <mpi.h>

namespace plastron::meshing {

/// Returns a function that adds the constraints of the problem's joined edges and rigid bodies, for each level.
fem::MeshSequence::Finish joining(const problem::Problem& problem);
/// Returns joined edges and the edges of rigid bodies: no node may hang there.
fem::MeshSequence::Even even_boundaries(const problem::Problem& problem);
/// Returns the coarsest mesh of the problem's cells and degree (collective).
fem::MeshSequence mesh_sequence(const problem::Problem& problem, MPI_Comm comm);

}  // namespace plastron::meshing
