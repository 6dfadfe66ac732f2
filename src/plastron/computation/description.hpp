// The data of a problem that its discretisation needs, in one place. A study without the element, the tying or the
// formulation of the case would examine another shell.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <mpi.h>

namespace plastron::computation {

assembly::ShellDescription shell_description(const Problem& problem);
/// Returns a function that ties the nodes on the problem's joined edges and lets rigid bodies carry their nodes, for
/// each level.
fem::MeshSequence::Finish joining(const Problem& problem);
/// Returns joined edges and the edges of rigid bodies: no node may hang there.
fem::MeshSequence::Even even_boundaries(const Problem& problem);
/// Returns the coarsest mesh of the problem's cells and degree (collective).
fem::MeshSequence mesh_sequence(const Problem& problem, MPI_Comm comm);

}  // namespace plastron::computation
