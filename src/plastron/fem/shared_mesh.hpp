// Mesh files in a job of several processes: one reads and examines the file, the others are told what it made of it.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <mpi.h>

namespace plastron::fem {

/// The same domain; of a mesh file with the coarse mesh of that shape beside its path, read by the first rank, so that coarse_mesh() has
/// nothing to read any more. A file that is no mesh is left unread, and coarse_mesh() says why; so are all where some ranks have another domain (collective).
Domain with_shared_mesh(Domain domain, Shape shape, MPI_Comm comm);

}  // namespace plastron::fem
