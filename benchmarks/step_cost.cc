// Compares the cost of a conjugate-gradient step with a kept factor and of a factorisation, by size: step_cost [DEGREE REFINEMENTS].
// Times are those of the calling thread, so that other work on the machine disturbs little. The constants in
// price_of (algebra/factorisation.cc) and in contact/subproblem.cc come from here.
#include "problems.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/session.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/contact/subproblem.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <cstdlib>
#include <ctime>
#include <functional>

namespace plastron::benchmarks {
namespace {

/// CPU seconds of one call.
double time(int calls, const std::function<void()>& call) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  for (int i = 0; i < calls; ++i) call();
  return (now() - start) / calls;
}

void report(int degree, int refinements) {
  const problem::Problem problem = cap(0.02, degree, refinements);
  fem::MeshSequence meshes(domain::coarse_mesh(problem.domain, problem.discretisation.cells), degree, MPI_COMM_WORLD);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);
  for (int i = 0; i < refinements; ++i) meshes.refine({});
  const auto discrete = assembly::discretise(meshes.space(), surface, problem.shell);
  const algebra::Matrix A = assembly::stiffness_matrix(*discrete);
  const contact::BoxProblem box = assembly::box_problem(*discrete, A);
  algebra::Factorisation F(A);
  std::vector<char> held(box.load.owned().size());
  for (std::size_t i = 0; i < held.size(); ++i) held[i] = box.lower.owned()[i] == box.upper.owned()[i];
  algebra::Vector z(box.load.layout(), box.load.block()), r = z;
  const double factorisation = time(2, [&] { F.factorise(held); });
  const double solve = time(5, [&] { F.solve(box.load, z); });
  z.update_ghosts();
  const double product = time(5, [&] { box.apply(z, r); });
  const double step = solve + 2 * product, n = static_cast<double>(held.size());
  fmt::print("{:>6} {:>9.0f} {:>10.3g} {:>10.3g} {:>8.3f} {:>8.4f} {:>8.4f} {:>8.1f} {:>8.2f} {:>8.2f} {:>10d}\n",
             degree, n, F.cost().entries, F.cost().operations, factorisation, solve, product, factorisation / step,
             1e9 * solve / F.cost().entries, 1e9 * product / n, contact::affordable_steps(F.price(), n));
  std::fflush(stdout);
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv, 1);
  using plastron::benchmarks::report;
  fmt::print("{:>6} {:>9} {:>10} {:>10} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>10}\n", "degree", "unknowns", "entries",
             "operations", "factor", "solve", "product", "in steps", "ns/entry", "ns/unkn", "affordable");
  if (argc == 3) {
    report(std::atoi(argv[1]), std::atoi(argv[2]));
    return 0;
  }
  for (const int refinements : {4, 5, 6}) report(2, refinements);
  for (const int refinements : {3, 4, 5}) report(4, refinements);
}
