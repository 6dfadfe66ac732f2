#include "petsc_use.hpp"

#include <slepcsys.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <string>

namespace plastron::algebra {
namespace {

// Hides the environment from PETSc while this object exists.
class WithoutOptionsOfTheEnvironment {
 public:
  WithoutOptionsOfTheEnvironment() {
    if (const char* value = std::getenv(name)) options_ = value;
    unsetenv(name);
  }
  ~WithoutOptionsOfTheEnvironment() {
    if (options_) setenv(name, options_->c_str(), 1);
  }
  WithoutOptionsOfTheEnvironment(const WithoutOptionsOfTheEnvironment&) = delete;
  WithoutOptionsOfTheEnvironment& operator=(const WithoutOptionsOfTheEnvironment&) = delete;

 private:
  static constexpr const char* name = "PETSC_OPTIONS";
  std::optional<std::string> options_{};
};

int end_slepc(MPI_Comm, int, void*, void*) {
  PetscBool has_ended = PETSC_FALSE;
  PetscErrorPrintf = PetscErrorPrintfNone;  // it would report a standard output that was closed
  if (PetscFinalized(&has_ended) == 0 && !has_ended) SlepcFinalize();
  return MPI_SUCCESS;
}

// MPI_Finalize first deletes the attributes of MPI_COMM_SELF. This is the last moment at which PETSc can end.
void end_slepc_before_mpi() {
  int key = MPI_KEYVAL_INVALID;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, end_slepc, &key, nullptr);
  MPI_Comm_set_attr(MPI_COMM_SELF, key, nullptr);
  MPI_Comm_free_keyval(&key);
}

}  // namespace

// PETSc sees these arguments in place of our command line: no file, no signal handler that prints, no report at the
// end. If PETSc already runs, it does not read them. SLEPc ends PETSc if it has started it.
bool start_slepc(MPI_Comm world) {
  if (SlepcInitializeCalled) return false;
  const WithoutOptionsOfTheEnvironment without_options;
  std::array words{const_cast<char*>("plastron"), const_cast<char*>("-skip_petscrc"),
                   const_cast<char*>("1"),        const_cast<char*>("-no_signal_handler"),
                   const_cast<char*>("1"),        const_cast<char*>("-options_left"),
                   const_cast<char*>("0"),        static_cast<char*>(nullptr)};
  int count = static_cast<int>(words.size()) - 1;
  char** arguments = words.data();
  PetscBool runs = PETSC_FALSE;
  petsc_check(PetscInitialized(&runs), "asking whether it runs");
  if (!runs) PETSC_COMM_WORLD = world;
  petsc_check(SlepcInitialize(&count, &arguments, nullptr, nullptr), "starting");
  return true;
}

// Each process starts PETSc by itself, since others may need it later or never. If PETSc belongs to the program, SLEPc
// ends with it.
PetscUse::PetscUse() : print_(PetscErrorPrintf) {
  PetscBool runs = PETSC_FALSE;
  petsc_check(PetscInitialized(&runs), "asking whether it runs");
  if (start_slepc(MPI_COMM_SELF)) {
    if (runs)
      petsc_check(PetscRegisterFinalize(SlepcFinalize), "arranging the end of SLEPc");
    else
      end_slepc_before_mpi();
  }
  petsc_check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "silencing its error handler");
  PetscErrorPrintf = PetscErrorPrintfNone;  // CHOLMOD's handler prints by itself
}

PetscUse::~PetscUse() {
  PetscErrorPrintf = print_;
  PetscPopErrorHandler();
}

}  // namespace plastron::algebra
