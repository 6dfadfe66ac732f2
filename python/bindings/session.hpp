// MPI and PETSc inside an interpreter: they start with the first computation, and end before the interpreter does.
#pragma once
#include <mpi.h>

#include <pybind11/pybind11.h>

#include <functional>

namespace plastron::python {

namespace py = pybind11;

/// Starts the session if it does not run yet. `threads` counts only then.
void start_session(int threads);

/// Ends the session. Objects that release_at_end() keeps are released before.
void end_session();

/// What must be released before MPI ends. It counts from construction to destruction.
class Releasable {
 public:
  Releasable();
  Releasable(const Releasable&) = delete;
  Releasable& operator=(const Releasable&) = delete;
  virtual ~Releasable();
  virtual void release() = 0;
};

/// Returns the communicator of "world", "self" or an mpi4py communicator; starts the session.
MPI_Comm communicator(const py::object& comm);

}  // namespace plastron::python
