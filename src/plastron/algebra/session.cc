#include <plastron/algebra/session.hpp>
#include <plastron/algebra/threads.hpp>

#include <slepcsys.h>

#include <array>
#include <cstdlib>

#include "petsc_check.hpp"

namespace plastron::algebra {
namespace {

bool we_started_mpi = false;

void start_mpi(int& argc, char**& argv) {
  int started = 0;
  MPI_Initialized(&started);
  we_started_mpi = !started;
  if (we_started_mpi) MPI_Init(&argc, &argv);
}

// The words PETSc sees in place of our command line: no file, no signal handler that prints, no report at the end. SLEPc
// starts and ends PETSc.
void start_petsc_and_slepc() {
  unsetenv("PETSC_OPTIONS");
  std::array words{const_cast<char*>("plastron"), const_cast<char*>("-skip_petscrc"),
                   const_cast<char*>("1"),        const_cast<char*>("-no_signal_handler"),
                   const_cast<char*>("1"),        const_cast<char*>("-options_left"),
                   const_cast<char*>("0"),        static_cast<char*>(nullptr)};
  int count = static_cast<int>(words.size()) - 1;
  char** arguments = words.data();
  petsc_check(SlepcInitialize(&count, &arguments, nullptr, nullptr), "starting");
  petsc_check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "silencing its error handler");
  PetscErrorPrintf = PetscErrorPrintfNone;  // CHOLMOD's handler prints by itself
}

int number_of_ranks() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

}  // namespace

Session::Session(int& argc, char**& argv, int threads) {
  start_mpi(argc, argv);
  restrict_threads(threads, number_of_ranks());
  start_petsc_and_slepc();
}

Session::~Session() {
  PetscPopErrorHandler();
  SlepcFinalize();
  if (we_started_mpi) MPI_Finalize();
}

}  // namespace plastron::algebra
