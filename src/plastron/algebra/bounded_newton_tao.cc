#include <plastron/algebra/bounded_newton.hpp>

#include <petsctao.h>

#include "newton_callbacks.hpp"
#include "petsc_use.hpp"

namespace plastron::algebra {
namespace {

using OwnedTao = Owned<Tao, TaoDestroy>;

PetscErrorCode energy(Tao, Vec x, PetscReal* value, Vec gradient, void* context) {
  return callbacks(context).evaluate(x, value, gradient);
}

PetscErrorCode energy_alone(Tao, Vec x, PetscReal* value, void* context) {
  return callbacks(context).evaluate(x, value, nullptr);
}

PetscErrorCode gradient_alone(Tao, Vec x, Vec gradient, void* context) {
  return callbacks(context).evaluate(x, nullptr, gradient);
}

PetscErrorCode constant_matrix(Tao, Vec, Mat A, Mat, void*) {
  PetscCall(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
  return MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY);
}

PetscErrorCode converged(Tao tao, void* context) {
  Vec x = nullptr;
  PetscInt iteration = 0;
  bool ends = false;
  PetscCall(TaoGetSolution(tao, &x));
  PetscCall(TaoGetIterationNumber(tao, &iteration));
  PetscCall(callbacks(context).look_at(static_cast<int>(iteration), x, ends));
  return ends ? TaoSetConvergedReason(tao, callbacks(context).end() == BoundedNewtonEnd::converged ? TAO_CONVERGED_USER
                                                                                                   : TAO_DIVERGED_USER)
              : 0;
}

}  // namespace

BoundedNewtonEnd minimise_with_tao(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings, Vector& x) {
  constexpr const char* preparing = "preparing TAO";
  const PetscUse petsc;
  const PrivateOptions none;
  NewtonCallbacks calls(problem, settings);
  OwnedVec point;
  OwnedTao tao;
  KSP ksp = nullptr;
  petsc_check(TaoCreate(problem.load.layout()->comm, tao.out()), preparing);
  petsc_check(TaoSetType(tao.get(), TAOBNLS), preparing);
  petsc_check(TaoSetSolution(tao.get(), calls.create(x, point)), preparing);
  petsc_check(TaoSetVariableBounds(tao.get(), calls.bounds(false), calls.bounds(true)), preparing);
  petsc_check(TaoSetObjective(tao.get(), energy_alone, &calls), preparing);
  petsc_check(TaoSetGradient(tao.get(), nullptr, gradient_alone, &calls), preparing);
  petsc_check(TaoSetObjectiveAndGradient(tao.get(), nullptr, energy, &calls), preparing);
  petsc_check(TaoSetHessian(tao.get(), calls.matrix(), calls.matrix(), constant_matrix, nullptr), preparing);
  petsc_check(TaoSetConvergenceTest(tao.get(), converged, &calls), preparing);
  petsc_check(TaoSetMaximumIterations(tao.get(), settings.max_iterations + 1), preparing);  // look_at() counts
  petsc_check(TaoGetKSP(tao.get(), &ksp), preparing);
  calls.use_for(ksp);
  const BoundedNewtonEnd end = calls.outcome(TaoSolve(tao.get()));
  calls.copy(point.get(), x);
  return end;
}

}  // namespace plastron::algebra
