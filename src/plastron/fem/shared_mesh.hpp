// Mesh files in a job of several processes: one process reads and checks the file and sends the mesh to the others.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <mpi.h>

namespace plastron::fem {

/// Returns the domain. A mesh file gets the coarse mesh of the given shape, read by the first rank, so that
/// coarse_mesh() need not read the file (collective). It gets none if the file is invalid; coarse_mesh() then reports
/// the error. It also gets none if some ranks have another kind of domain.
Domain with_shared_mesh(Domain domain, Shape shape, MPI_Comm comm);

}  // namespace plastron::fem
