// What TAO and SNES have in common: vectors and the matrix as shells around our functions. Included by .cc files only.
#pragma once
#include <plastron/algebra/bounded_newton.hpp>

#include <petscksp.h>

#include <deque>
#include <exception>
#include <vector>

#include "petsc_check.hpp"

namespace plastron::algebra {

/// Destroys a PETSc object in the end.
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

/// A on the unknowns that are not held, as the context of a MATSHELL.
struct Face {
  NewtonCallbacks* callbacks = nullptr;
  std::vector<char> held{};
};

/// One solution of a BoundedQuadratic by PETSc. Its static functions are PETSc's callbacks; exceptions wait in it, since they must not
/// pass PETSc's frames.
class NewtonCallbacks {
 public:
  NewtonCallbacks(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings);
  NewtonCallbacks(const NewtonCallbacks&) = delete;
  NewtonCallbacks& operator=(const NewtonCallbacks&) = delete;

  Vec bounds(bool upper) const { return (upper ? upper_ : lower_).get(); }
  Mat matrix() const { return matrix_.get(); }
  Vec create(const Vector& values, OwnedVec& vec) const;  ///< a vector of PETSc's own with these values
  void use_for(KSP ksp);                                  ///< one application of solve_on_face in place of an iteration
  void copy(Vec from, Vector& to) const;                  ///< owned values, ghosts updated

  /// energy and gradient at x; `gradient` may be null
  PetscErrorCode evaluate(Vec x, double* energy, Vec gradient);
  /// Whether to end at the iterate x, and how.
  PetscErrorCode look_at(int iteration, Vec x, bool& ends);
  BoundedNewtonEnd end() const { return end_; }
  /// After PETSc returned `code`: throws what a callback threw; what went wrong in PETSc itself is `failed`.
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
  std::deque<Face> faces_{};  ///< of all shells that were made: PETSc keeps some for long
  Vector point_, product_;    ///< what callbacks work on
  OwnedVec lower_{}, upper_{};
  OwnedMat matrix_{};
  BoundedNewtonEnd end_ = BoundedNewtonEnd::failed;
  bool has_no_face_solution_ = false;
  std::exception_ptr thrown_{};
};

inline NewtonCallbacks& callbacks(void* context) { return *static_cast<NewtonCallbacks*>(context); }

/// Keeps what `function` throws for later and tells PETSc of an error.
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
