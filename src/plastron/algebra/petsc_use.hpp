// Use of PETSc and SLEPc: started if not yet running, without output and options of others during our calls, and
// otherwise unchanged. Errors are exceptions. Included by .cc files only: no header of ours shows PETSc.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <petscsys.h>
#include <petscvec.h>

#include <new>
#include <stdexcept>
#include <string>

namespace plastron::algebra {

/// Starts SLEPc on `world`, and PETSc if it does not run either. Returns false if SLEPc ran already. (collective on
/// `world`)
bool start_slepc(MPI_Comm world);

/// While this object exists, PETSc prints nothing: its errors are returned as codes, see petsc_check(). Starts PETSc if
/// it does not run, in each process separately, until MPI_Finalize.
class PetscUse {
 public:
  PetscUse();
  ~PetscUse();
  PetscUse(const PetscUse&) = delete;
  PetscUse& operator=(const PetscUse&) = delete;

 private:
  PetscErrorCode (*print_)(const char[], ...);
};

/// Whether memory was insufficient; CHOLMOD reports this with its status -2.
inline bool is_out_of_memory(PetscErrorCode code, const std::string& message) {
  return code == PETSC_ERR_MEM || message.find("CHOLMOD factorization failed with status -2") != std::string::npos;
}

/// Throws std::runtime_error with PETSc's message, or std::bad_alloc where memory was insufficient. `doing` names the
/// requested operation.
inline void petsc_check(PetscErrorCode code, const char* doing) {
  if (code == 0) return;
  const char* general = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &general, &specific);
  std::string message = std::string("PETSc failed while ") + doing + ": " + (general ? general : "unknown error");
  if (specific && *specific) message += std::string(" (") + specific + ")";
  if (is_out_of_memory(code, message)) throw std::bad_alloc();
  throw std::runtime_error(message);
}

/// A private database of PETSc options during a call. Options that the program or its user has set for other
/// solvers do not affect ours.
class PrivateOptions {
 public:
  PrivateOptions() {
    petsc_check(PetscOptionsCreate(&options_), "creating options");
    petsc_check(PetscOptionsPush(options_), "using private options");
  }
  ~PrivateOptions() {
    PetscOptionsPop();
    PetscOptionsDestroy(&options_);
  }
  PrivateOptions(const PrivateOptions&) = delete;
  PrivateOptions& operator=(const PrivateOptions&) = delete;
  void add(const char* name, const char* value) {
    petsc_check(PetscOptionsSetValue(options_, name, value), "setting an option");
  }

 private:
  PetscOptions options_ = nullptr;
};

/// A PETSc vector without values of its own. It uses our owned values while they are lent to it.
class BorrowedVec {
 public:
  /// (collective)
  BorrowedVec(const Layout& layout, int block) {
    petsc_check(VecCreateMPIWithArray(layout.comm, 1, layout.owned * block, PETSC_DETERMINE, nullptr, &vec_),
                "wrapping a vector");
  }
  ~BorrowedVec() { VecDestroy(&vec_); }
  BorrowedVec(const BorrowedVec&) = delete;
  BorrowedVec& operator=(const BorrowedVec&) = delete;
  Vec vec() const { return vec_; }

  /// Makes `values` the values of `vec` during a call.
  class Loan {
   public:
    Loan(const BorrowedVec& vec, const double* values) : vec_(vec.vec_) {
      petsc_check(VecPlaceArray(vec_, values), "wrapping a vector");
    }
    ~Loan() { VecResetArray(vec_); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

   private:
    Vec vec_;
  };

 private:
  Vec vec_ = nullptr;
};

}  // namespace plastron::algebra
