// The common part of TAO and SNES: PETSc vectors and matrices as shells around our functions. Included by .cc files
// only.
#pragma once
#include <plastron/algebra/bounded_newton.hpp>

#include <petscksp.h>

#include <deque>
#include <exception>
#include <vector>

#include "petsc_use.hpp"

namespace plastron::algebra {

/// Owns a PETSc object and destroys it.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { destroy(&object_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Object* out() { return &object_; }
  Object get() const { return object_; }

 private:
  Object object_ = nullptr;
};
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedMat = Owned<Mat, MatDestroy>;

class NewtonCallbacks;

/// A on the unknowns that are not fixed, as the context of a MATSHELL.
struct Face {
  NewtonCallbacks* callbacks = nullptr;
  std::vector<char> held{};
};

/// One solution of a BoundedQuadratic by PETSc. Its static functions are PETSc's callbacks. It keeps their exceptions,
/// which must not pass through PETSc's frames.
class NewtonCallbacks {
 public:
  NewtonCallbacks(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings);
  NewtonCallbacks(const NewtonCallbacks&) = delete;
  NewtonCallbacks& operator=(const NewtonCallbacks&) = delete;

  Vec bounds(bool upper) const { return (upper ? upper_ : lower_).get(); }
  Mat matrix() const { return matrix_.get(); }
  /// Returns a PETSc vector with its own storage and these values.
  Vec create(const Vector& values, OwnedVec& vec) const;
  void use_for(KSP ksp);                  ///< makes one application of solve_on_face replace an iteration
  void copy(Vec from, Vector& to) const;  ///< copies owned values, updates ghosts

  /// Computes energy and gradient at x; `gradient` may be null.
  PetscErrorCode evaluate(Vec x, double* energy, Vec gradient);
  /// Decides whether to end at the iterate x, and how.
  PetscErrorCode look_at(int iteration, Vec x, bool& ends);
  BoundedNewtonEnd end() const { return end_; }
  /// Returns the end of the solution after PETSc returned `code`. Throws the exception of a callback; an error of PETSc
  /// itself is `failed`.
  BoundedNewtonEnd outcome(PetscErrorCode code) const;

 private:
  static PetscErrorCode multiply(Mat A, Vec x, Vec y);
  static PetscErrorCode restrict_to(Mat A, IS rows, IS columns, MatReuse reuse, Mat* restricted);
  static PetscErrorCode diagonal(Mat A, Vec d);
  static PetscErrorCode solve(PC pc, Vec r, Vec s);
  Mat shell(Face& face, PetscInt size);
  void expand(const Face& face, Vec reduced, Vector& whole) const;
  void reduce(const Face& face, const Vector& whole, Vec reduced) const;
  double residual(const Vector& x, const Vector& gradient) const;

  template <class Function>
  PetscErrorCode guarded(Function&& function);

  const BoundedQuadratic& problem_;
  const BoundedNewtonSettings& settings_;
  std::deque<Face> faces_{};  ///< faces of all shells, because PETSc keeps some shells for long
  Vector point_, product_;    ///< scratch vectors of callbacks
  OwnedVec lower_{}, upper_{};
  OwnedMat matrix_{};
  BoundedNewtonEnd end_ = BoundedNewtonEnd::failed;
  bool has_no_face_solution_ = false;
  std::exception_ptr thrown_{};
};

inline NewtonCallbacks& callbacks(void* context) { return *static_cast<NewtonCallbacks*>(context); }

/// Keeps the exception of `function` for later and returns an error to PETSc.
template <class Function>
PetscErrorCode NewtonCallbacks::guarded(Function&& function) {
  try {
    function();
    return 0;
  } catch (...) {
    thrown_ = std::current_exception();
    return PETSC_ERR_USER;
  }
}

}  // namespace plastron::algebra
