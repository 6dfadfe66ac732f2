// A program that starts MPI, PETSc or SLEPc itself, or none of them, and uses the library with or without a Session:
//   session_owner OWNED USE      OWNED: nothing mpi petsc slepc      USE: session bare
// Checks that everything that ran before still runs, that everything else has ended, and that linear algebra works in between. Prints any
// error and returns 1.
#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/session.hpp>

#include <mpi.h>
#include <petscsys.h>
#include <slepcsys.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

bool has_failed = false;

void expect(bool condition, const char* what) {
  if (condition) return;
  has_failed = true;
  std::fprintf(stderr, "wrong: %s\n", what);
}

struct Running {
  bool mpi, petsc, slepc;
  bool operator==(const Running&) const = default;
};

Running what_runs() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  PetscBool petsc = PETSC_FALSE;
  PetscInitialized(&petsc);
  return {started && !ended, petsc == PETSC_TRUE, SlepcInitializeCalled == PETSC_TRUE};
}

Matrix springs(double ground) {
  const GlobalIndex n = 23;
  const auto elements = chain(n);
  const auto layout = layout_for(n, elements);
  Matrix A(layout, 1, connectivity(*layout, elements));
  for (const auto& element : elements)
    if (layout->owns(element[0]))
      A.add(local_nodes(*layout, element), std::vector<double>{1 + ground, -1, -1, 1 + ground});
  A.finish();
  return A;
}

void compute() {
  const Matrix A = springs(0.5);
  const std::vector<char> nothing(A.diagonal().owned().size(), 0);
  algebra::Factorisation F(A);
  expect(F.factorise(nothing), "a positive definite matrix is factorised");
  Vector b = A.diagonal(), x(A.layout(), 1), Ax(A.layout(), 1);
  F.solve(b, x);
  A.multiply(x, Ax);
  algebra::axpy(-1, b, Ax);
  expect(algebra::max_abs(Ax) < 1e-12, "a linear system is solved");
  const Matrix wrong = springs(-0.5);
  expect(!algebra::Factorisation(wrong).factorise(nothing), "an indefinite matrix is refused, without a word");
  const Matrix B = springs(0.25);
  const auto pairs = algebra::smallest_eigenpairs(A, B, nothing, 0);
  expect(pairs.converged && pairs.values[0] > 1 && pairs.values[0] < 2, "an eigenvalue is found");
}

void start(const std::string& owned, int& argc, char**& argv) {
  if (owned == "mpi") MPI_Init(&argc, &argv);
  if (owned == "petsc") PetscInitialize(&argc, &argv, nullptr, nullptr);
  if (owned == "slepc") SlepcInitialize(&argc, &argv, nullptr, nullptr);
}

void end(const std::string& owned) {
  if (owned == "mpi") MPI_Finalize();
  if (owned == "petsc") PetscFinalize();
  if (owned == "slepc") SlepcFinalize();
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string owned = argv[1], use = argv[2];
  setenv("PETSC_OPTIONS", "-options_left 0", 1);
  start(owned, argc, argv);
  const Running before = what_runs();
  for (int round = 0; round < (owned == "nothing" ? 1 : 2); ++round) {  // MPI starts once in a process
    std::optional<algebra::Session> session;
    if (use == "session") session.emplace(argc, argv, 1);
    compute();
    session.reset();
    if (use == "session") expect(what_runs() == before, "a Session ends what it started, and nothing else");
    expect(before.mpi <= what_runs().mpi && before.petsc <= what_runs().petsc, "what ran before goes on running");
  }
  expect(std::getenv("PETSC_OPTIONS") != nullptr, "the environment is as it was");
  end(owned);
  expect(what_runs() == Running{false, false, false}, "nothing runs in the end");
  return has_failed ? 1 : 0;
}

}  // namespace
}  // namespace plastron::test

int main(int argc, char** argv) { return plastron::test::main(argc, argv); }
