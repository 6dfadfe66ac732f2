#include <plastron/algebra/session.hpp>
#include <plastron/algebra/threads.hpp>

#include <slepcsys.h>

#include "petsc_use.hpp"

namespace plastron::algebra {
namespace {

bool start_mpi(int& argc, char**& argv) {
  int runs = 0;
  MPI_Initialized(&runs);
  if (!runs) MPI_Init(&argc, &argv);
  return !runs;
}

bool mpi_has_ended() {
  int ended = 0;
  MPI_Finalized(&ended);
  return ended != 0;
}

int number_of_ranks() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

}  // namespace

Session::Session(int& argc, char**& argv, int threads) : owns_mpi_(start_mpi(argc, argv)), owns_slepc_(false) {
  restrict_threads(threads, number_of_ranks());
  owns_slepc_ = start_slepc(MPI_COMM_WORLD);
}

Session::~Session() {
  if (mpi_has_ended()) return;
  PetscErrorPrintf = PetscErrorPrintfNone;  // it would tell of a standard output that was closed
  if (owns_slepc_) SlepcFinalize();
  if (owns_mpi_) MPI_Finalize();
}

}  // namespace plastron::algebra
