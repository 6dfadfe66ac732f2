// Active-set iterations by level: caps and strips from thick to thin. active_set_iterations [DEGREE REFINEMENTS_CAP
// REFINEMENTS_STRIP]; without arguments degree 2 up to about 400 000 and 330 000 unknowns.
#include "problems.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>

namespace plastron::benchmarks {
namespace {

int report(const char* name, double e, const problem::Problem& problem) {
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  fmt::print("{:<6} e = {:<6g} {:<8} up to {:>7} unknowns, contact area {:.4f}: iterations", name, e,
             contact::to_string(result.status), result.levels.back().unknowns, result.summary.contact_area);
  int most = 0;
  for (std::size_t l = 0; l < result.levels.size(); ++l) {
    fmt::print(" {}", result.levels[l].iterations);
    if (l > 0) most = std::max(most, result.levels[l].iterations);
  }
  fmt::print("\n");
  std::fflush(stdout);
  return most;
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  using namespace plastron::benchmarks;
  const plastron::algebra::Session session(argc, argv);
  const int degree = argc == 4 ? std::atoi(argv[1]) : 2, caps = argc == 4 ? std::atoi(argv[2]) : 6,
            strips = argc == 4 ? std::atoi(argv[3]) : 6;
  int most = 0;
  for (const double e : {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001}) {
    most = std::max(most, report("cap", e, cap(e, degree, caps)));
    most = std::max(most, report("strip", e, strip(e, degree, strips)));
  }
  fmt::print("most on a level but the coarsest: {}\n", most);
}
