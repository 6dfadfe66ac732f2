#include <research/referees/bounded_newton.hpp>

#include <petsctao.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::referees {
namespace {

using algebra::Vector;

/// Throws std::runtime_error with PETSc's message. `doing` names the requested operation.
void petsc_check(PetscErrorCode code, const char* doing) {
  if (code == 0) return;
  const char* message = nullptr;
  PetscErrorMessage(code, &message, nullptr);
  throw std::runtime_error(std::string("PETSc failed while ") + doing + ": " + (message ? message : "unknown error"));
}

/// While this object exists, PETSc prints nothing: its errors are returned as codes. PETSc runs, because the program
/// has an algebra::Session.
class SilentPetsc {
 public:
  SilentPetsc() : print_(PetscErrorPrintf) {
    petsc_check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "silencing its error handler");
    PetscErrorPrintf = PetscErrorPrintfNone;
  }
  ~SilentPetsc() {
    PetscErrorPrintf = print_;
    PetscPopErrorHandler();
  }
  SilentPetsc(const SilentPetsc&) = delete;
  SilentPetsc& operator=(const SilentPetsc&) = delete;

 private:
  PetscErrorCode (*print_)(const char[], ...);
};

MPI_Comm comm_of(const BoundedQuadratic& problem) { return problem.load.layout()->comm; }

PetscInt owned_size(const BoundedQuadratic& problem) { return static_cast<PetscInt>(problem.load.owned().size()); }

Vector zeros_like(const Vector& v) { return Vector(v.layout(), v.block()); }

/// Returns bounds for PETSc, which treats numbers beyond a limit as infinity.
Vector in_petsc_words(Vector bounds) {
  for (double& bound : bounds.owned())
    bound = std::clamp(bound, static_cast<double>(PETSC_NINFINITY), static_cast<double>(PETSC_INFINITY));
  return bounds;
}

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
  std::vector<char> fixed{};
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
  for (std::size_t i = 0; i < face.fixed.size(); ++i) whole.owned()[i] = face.fixed[i] ? 0 : array[at++];
  petsc_check(VecRestoreArrayRead(reduced, &array), "reading a vector");
  whole.update_ghosts();
}

void NewtonCallbacks::reduce(const Face& face, const Vector& whole, Vec reduced) const {
  PetscScalar* array = nullptr;
  petsc_check(VecGetArrayWrite(reduced, &array), "writing to a vector");
  std::size_t at = 0;
  for (std::size_t i = 0; i < face.fixed.size(); ++i)
    if (!face.fixed[i]) array[at++] = whole.owned()[i];
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
    Face& smaller = self.faces_.emplace_back(Face{&self, std::vector<char>(face->fixed.size(), 1)});
    for (PetscInt k = 0; k < size; ++k) smaller.fixed[static_cast<std::size_t>(index[k] - first)] = 0;
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
    if (!self.problem_.solve_on_face(face->fixed, self.point_, self.product_)) {
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
    algebra::axpy(-1, problem_.load, product_);
    if (energy) *energy = 0.5 * (algebra::dot(point_, product_) - algebra::dot(point_, problem_.load));
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
  return std::sqrt(algebra::sum_over_ranks(sum, comm_of(problem_)));
}

PetscErrorCode NewtonCallbacks::look_at(int iteration, Vec x, bool& ends) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  return guarded([&] {
    copy(x, point_);
    problem_.apply(point_, product_);
    algebra::axpy(-1, problem_.load, product_);
    const bool goes_on = !settings_.go_on || settings_.go_on(iteration, point_, product_);
    ends = true;
    if (residual(point_, product_) <= std::max(settings_.tolerance, rounding * algebra::norm(point_)))
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

NewtonCallbacks& callbacks(void* context) { return *static_cast<NewtonCallbacks*>(context); }

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
  const SilentPetsc silent;
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

}  // namespace plastron::referees
