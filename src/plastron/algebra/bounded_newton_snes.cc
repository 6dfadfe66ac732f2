#include <plastron/algebra/bounded_newton.hpp>

#include <petscsnes.h>

#include "newton_callbacks.hpp"
#include "petsc_use.hpp"

namespace plastron::algebra {
namespace {

using OwnedSnes = Owned<SNES, SNESDestroy>;

PetscErrorCode residual(SNES, Vec x, Vec f, void* context) { return callbacks(context).evaluate(x, nullptr, f); }

PetscErrorCode constant_matrix(SNES, Vec, Mat A, Mat, void*) {
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  return MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY);
}

PetscErrorCode converged(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal, SNESConvergedReason* reason,
                         void* context) {
  Vec x = nullptr;
  bool ends = false;
  PetscCall(SNESGetSolution(snes, &x));
  PetscCall(callbacks(context).look_at(static_cast<int>(iteration), x, ends));
  *reason = !ends ? SNES_CONVERGED_ITERATING
                  : (callbacks(context).end() == BoundedNewtonEnd::converged ? SNES_CONVERGED_FNORM_RELATIVE
                                                                             : SNES_DIVERGED_INNER);
  return 0;
}

}  // namespace

BoundedNewtonEnd solve_with_snesvi(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings, Vector& x) {
  constexpr const char* preparing = "preparing SNESVI";
  const PetscUse petsc;
  const PrivateOptions none;
  NewtonCallbacks calls(problem, settings);
  OwnedVec point, value;
  OwnedSnes snes;
  KSP ksp = nullptr;
  calls.create(x, point);
  calls.create(x, value);
  petsc_check(SNESCreate(problem.load.layout()->comm, snes.out()), preparing);
  petsc_check(SNESSetType(snes.get(), SNESVINEWTONRSLS), preparing);
  petsc_check(SNESSetFunction(snes.get(), value.get(), residual, &calls), preparing);
  petsc_check(SNESSetJacobian(snes.get(), calls.matrix(), calls.matrix(), constant_matrix, nullptr), preparing);
  petsc_check(SNESVISetVariableBounds(snes.get(), calls.bounds(false), calls.bounds(true)), preparing);
  petsc_check(SNESSetConvergenceTest(snes.get(), converged, &calls, nullptr), preparing);
  petsc_check(SNESSetTolerances(snes.get(), 0, 0, 0, settings.max_iterations + 1, PETSC_MAX_INT), preparing);
  petsc_check(SNESGetKSP(snes.get(), &ksp), preparing);
  calls.use_for(ksp);
  const BoundedNewtonEnd end = calls.outcome(SNESSolve(snes.get(), nullptr, point.get()));
  calls.copy(point.get(), x);
  return end;
}

}  // namespace plastron::algebra
