// MPI and PETSc inside an interpreter: they start with the first computation, and end before the interpreter does.
#pragma once
#include <mpi.h>

#include <pybind11/pybind11.h>

namespace plastron::python {

namespace py = pybind11;

/// Starts the session if it does not run yet. `threads` counts only then.
void start_session(int threads);

/// Releases all Releasable objects and ends the session.
void end_session();

/// An object that end_session() releases, because it cannot outlive MPI.
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

/// Whether this thread is in a computation.
bool& is_computing();

/// The libraries serve one thread at a time. This object waits until no other thread uses them. Make it without the interpreter's
/// lock, because a computation may call functions of Python. In a callback its thread has the libraries already.
class Turn {
 public:
  Turn();
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  bool is_first_;
};

/// Waits until no other thread computes. No thread begins a computation before end_fork(). A child process has a copy of this thread
/// alone, and would keep the half-done computation of another one. The child calls end_fork(), too. Ctrl-C ends the waiting.
void begin_fork();
void end_fork();

}  // namespace plastron::python
