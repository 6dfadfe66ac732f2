#include "newton_callbacks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::algebra {
namespace {

MPI_Comm comm_of(const BoundedQuadratic& problem) { return problem.load.layout()->comm; }

PetscInt owned_size(const BoundedQuadratic& problem) { return static_cast<PetscInt>(problem.load.owned().size()); }

Vector zeros_like(const Vector& v) { return Vector(v.layout(), v.block()); }

/// Returns bounds for PETSc, which treats numbers beyond a limit as infinity.
Vector in_petsc_words(Vector bounds) {
  for (double& bound : bounds.owned())
    bound = std::clamp(bound, static_cast<double>(PETSC_NINFINITY), static_cast<double>(PETSC_INFINITY));
  return bounds;
}

}  // namespace

NewtonCallbacks::NewtonCallbacks(const BoundedQuadratic& problem, const BoundedNewtonSettings& settings)
    : problem_(problem), settings_(settings), point_(zeros_like(problem.load)), product_(point_) {
  create(in_petsc_words(problem.lower), lower_);
  create(in_petsc_words(problem.upper), upper_);
  faces_.push_back({this, std::vector<char>(problem.load.owned().size(), 0)});
  *matrix_.out() = shell(faces_.back(), owned_size(problem));
}

Vec NewtonCallbacks::create(const Vector& values, OwnedVec& vec) const {
  petsc_check(VecCreateMPI(comm_of(problem_), owned_size(problem_), PETSC_DETERMINE, vec.out()), "creating a vector");
  PetscScalar* array = nullptr;
  petsc_check(VecGetArrayWrite(vec.get(), &array), "writing to a vector");
  std::ranges::copy(values.owned(), array);
  petsc_check(VecRestoreArrayWrite(vec.get(), &array), "writing to a vector");
  return vec.get();
}

void NewtonCallbacks::copy(Vec from, Vector& to) const {
  const PetscScalar* array = nullptr;
  petsc_check(VecGetArrayRead(from, &array), "reading a vector");
  std::copy_n(array, to.owned().size(), to.owned().begin());
  petsc_check(VecRestoreArrayRead(from, &array), "reading a vector");
  to.update_ghosts();
}

Mat NewtonCallbacks::shell(Face& face, PetscInt size) {
  Mat A = nullptr;
  petsc_check(MatCreateShell(comm_of(problem_), size, size, PETSC_DETERMINE, PETSC_DETERMINE, &face, &A),
              "making an operator");
  const auto provide = [&](MatOperation operation, auto* function) {
    petsc_check(MatShellSetOperation(A, operation, reinterpret_cast<void (*)()>(function)), "making an operator");
  };
  provide(MATOP_MULT, &NewtonCallbacks::multiply);
  provide(MATOP_MULT_TRANSPOSE, &NewtonCallbacks::multiply);
  provide(MATOP_GET_DIAGONAL, &NewtonCallbacks::diagonal);
  provide(MATOP_CREATE_SUBMATRIX, &NewtonCallbacks::restrict_to);
  return A;
}

void NewtonCallbacks::use_for(KSP ksp) {
  PC pc = nullptr;
  petsc_check(KSPSetType(ksp, KSPPREONLY), "choosing a linear solver");
  petsc_check(KSPGetPC(ksp, &pc), "choosing a linear solver");
  petsc_check(PCSetType(pc, PCSHELL), "choosing a linear solver");
  petsc_check(PCShellSetContext(pc, this), "choosing a linear solver");
  petsc_check(PCShellSetApply(pc, &NewtonCallbacks::solve), "choosing a linear solver");
}

void NewtonCallbacks::expand(const Face& face, Vec reduced, Vector& whole) const {
  const PetscScalar* array = nullptr;
  petsc_check(VecGetArrayRead(reduced, &array), "reading a vector");
  std::size_t at = 0;
  for (std::size_t i = 0; i < face.held.size(); ++i) whole.owned()[i] = face.held[i] ? 0 : array[at++];
  petsc_check(VecRestoreArrayRead(reduced, &array), "reading a vector");
  whole.update_ghosts();
}

void NewtonCallbacks::reduce(const Face& face, const Vector& whole, Vec reduced) const {
  PetscScalar* array = nullptr;
  petsc_check(VecGetArrayWrite(reduced, &array), "writing to a vector");
  std::size_t at = 0;
  for (std::size_t i = 0; i < face.held.size(); ++i)
    if (!face.held[i]) array[at++] = whole.owned()[i];
  petsc_check(VecRestoreArrayWrite(reduced, &array), "writing to a vector");
}

PetscErrorCode NewtonCallbacks::multiply(Mat A, Vec x, Vec y) {
  Face* face = nullptr;
  PetscCall(MatShellGetContext(A, &face));
  NewtonCallbacks& self = *face->callbacks;
  return self.guarded([&] {
    self.expand(*face, x, self.point_);
    self.problem_.apply(self.point_, self.product_);
    self.reduce(*face, self.product_, y);
  });
}

// The diagonal is 1 because of the scaling of the problem.
PetscErrorCode NewtonCallbacks::diagonal(Mat, Vec d) { return VecSet(d, 1.0); }

PetscErrorCode NewtonCallbacks::restrict_to(Mat A, IS rows, IS, MatReuse, Mat* restricted) {
  Face* face = nullptr;
  PetscCall(MatShellGetContext(A, &face));
  NewtonCallbacks& self = *face->callbacks;
  PetscInt size = 0, first = 0;
  const PetscInt* index = nullptr;
  PetscCall(ISGetLocalSize(rows, &size));
  PetscCall(ISGetIndices(rows, &index));
  PetscCall(MatGetOwnershipRange(A, &first, nullptr));
  const PetscErrorCode code = self.guarded([&] {
    Face& smaller = self.faces_.emplace_back(Face{&self, std::vector<char>(face->held.size(), 1)});
    for (PetscInt k = 0; k < size; ++k) smaller.held[static_cast<std::size_t>(index[k] - first)] = 0;
    *restricted = self.shell(smaller, size);
    petsc_check(MatAssemblyBegin(*restricted, MAT_FINAL_ASSEMBLY), "making an operator");
    petsc_check(MatAssemblyEnd(*restricted, MAT_FINAL_ASSEMBLY), "making an operator");
  });
  PetscCall(ISRestoreIndices(rows, &index));
  return code;
}

// If there is no solution, the direction is zero. look_at() then ends the iteration.
PetscErrorCode NewtonCallbacks::solve(PC pc, Vec r, Vec s) {
  void* context = nullptr;
  Mat A = nullptr;
  Face* face = nullptr;
  PetscCall(PCShellGetContext(pc, &context));
  PetscCall(PCGetOperators(pc, &A, nullptr));
  PetscCall(MatShellGetContext(A, &face));
  NewtonCallbacks& self = *static_cast<NewtonCallbacks*>(context);
  return self.guarded([&] {
    self.expand(*face, r, self.point_);
    self.product_.fill(0);
    if (!self.problem_.solve_on_face(face->held, self.point_, self.product_)) {
      self.has_no_face_solution_ = true;
      self.product_.fill(0);
    }
    self.reduce(*face, self.product_, s);
  });
}

PetscErrorCode NewtonCallbacks::evaluate(Vec x, double* energy, Vec gradient) {
  return guarded([&] {
    copy(x, point_);
    problem_.apply(point_, product_);
    axpy(-1, problem_.load, product_);
    if (energy) *energy = 0.5 * (dot(point_, product_) - dot(point_, problem_.load));
    if (gradient) reduce(faces_.front(), product_, gradient);
  });
}

double NewtonCallbacks::residual(const Vector& x, const Vector& gradient) const {
  double sum = 0;
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double z = x.owned()[i];
    const double r = z - std::clamp(z - gradient.owned()[i], problem_.lower.owned()[i], problem_.upper.owned()[i]);
    sum += r * r;
  }
  return std::sqrt(sum_over_ranks(sum, comm_of(problem_)));
}

PetscErrorCode NewtonCallbacks::look_at(int iteration, Vec x, bool& ends) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  return guarded([&] {
    copy(x, point_);
    problem_.apply(point_, product_);
    axpy(-1, problem_.load, product_);
    const bool goes_on = !settings_.go_on || settings_.go_on(iteration, point_, product_);
    ends = true;
    if (residual(point_, product_) <= std::max(settings_.tolerance, rounding * norm(point_)))
      end_ = BoundedNewtonEnd::converged;
    else if (has_no_face_solution_)
      end_ = BoundedNewtonEnd::no_face_solution;
    else if (!goes_on)
      end_ = BoundedNewtonEnd::stopped;
    else if (iteration >= settings_.max_iterations)
      end_ = BoundedNewtonEnd::iteration_limit;
    else
      ends = false;
  });
}

BoundedNewtonEnd NewtonCallbacks::outcome(PetscErrorCode code) const {
  if (thrown_) std::rethrow_exception(thrown_);
  return code == 0 ? end_ : BoundedNewtonEnd::failed;
}

}  // namespace plastron::algebra
