#include "session.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/algebra/threads.hpp>

#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace plastron::python {

namespace {

std::unique_ptr<algebra::Session>& session() {
  static std::unique_ptr<algebra::Session> only;
  return only;
}

std::set<Releasable*>& releasables() {
  static std::set<Releasable*> all;
  return all;
}

}  // namespace

Releasable::Releasable() { releasables().insert(this); }
Releasable::~Releasable() { releasables().erase(this); }

void start_session(int threads) {
  if (session()) return;
  int count = 0;
  char** arguments = nullptr;
  session() = std::make_unique<algebra::Session>(count, arguments, threads);
}

void end_session() {
  for (Releasable* object : releasables()) object->release();
  session().reset();
}

MPI_Comm communicator(const py::object& comm) {
  start_session(0);
  if (py::isinstance<py::str>(comm)) {
    const auto name = comm.cast<std::string>();
    if (name == "world") return MPI_COMM_WORLD;
    if (name == "self") return MPI_COMM_SELF;
    throw py::value_error("comm is \"world\", \"self\" or a communicator of mpi4py, not \"" + name + "\"");
  }
  const py::module_ mpi = py::module_::import("mpi4py.MPI");
  if (!py::isinstance(comm, mpi.attr("Comm")))
    throw py::type_error("comm is \"world\", \"self\" or a communicator of mpi4py");
  const auto address = mpi.attr("_addressof")(comm).cast<std::uintptr_t>();
  return *reinterpret_cast<MPI_Comm*>(address);
}

namespace {

std::timed_mutex& one_at_a_time() {
  static std::timed_mutex mutex;
  return mutex;
}

}  // namespace

bool& is_computing() {
  thread_local bool flag = false;
  return flag;
}

Turn::Turn() : is_first_(!is_computing()) {
  if (!is_first_) return;
  one_at_a_time().lock();
  is_computing() = true;
  algebra::restrict_openmp();
}

Turn::~Turn() {
  if (!is_first_) return;
  is_computing() = false;
  one_at_a_time().unlock();
}

namespace {

bool& is_forking() {
  thread_local bool flag = false;
  return flag;
}

}  // namespace

void begin_fork() {
  if (is_computing()) return;  // a callback of a computation
  const auto locks = [] {
    const py::gil_scoped_release release;
    return one_at_a_time().try_lock_for(std::chrono::milliseconds(100));
  };
  while (!locks())
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  is_forking() = true;
}

void end_fork() {
  if (!is_forking()) return;
  is_forking() = false;
  one_at_a_time().unlock();
}

}  // namespace plastron::python
