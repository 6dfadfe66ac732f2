// What of a problem its discretisation needs, in one place: a study that left out the element, the tying or the
// formulation of the case would examine another shell.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <mpi.h>

namespace plastron::computation {

assembly::ShellDescription shell_description(const Problem& problem);
/// Ties the nodes on the problem's joined edges, and has its rigid bodies carry theirs, level by level.
fem::MeshSequence::Finish joining(const Problem& problem);
/// Joined edges and those of rigid bodies: no node may hang there.
fem::MeshSequence::Even even_boundaries(const Problem& problem);
/// The coarsest mesh of the problem's cells and degree (collective).
fem::MeshSequence mesh_sequence(const Problem& problem, MPI_Comm comm);

}  // namespace plastron::computation
