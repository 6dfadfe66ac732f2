// Cost by phase of three contact problems, on one rank or several: contact_cost [cap|barrel|strip [DEGREE [SIZE...]]]. Sizes 0 to 3 are about
// 26 000, 103 000, 410 000 and 1 640 000 unknowns; without arguments all problems at degree 2 and 4 to size 2.
#include "problems.hpp"

#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/session.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/workflow/output.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>
#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace plastron::benchmarks {
namespace {

problem::Problem problem_of(const std::string& name, int degree, int size) {
  const int less =
      degree == 4 ? 1 : 0;  // refinements: cells of degree 4 have four times as many nodes as those of degree 2
  if (name == "barrel") return barrel(degree, 2 + size - less);
  if (name == "strip") return strip(0.01, degree, 3 + size - less, {10, 2});
  return cap(0.02, degree, 4 + size - less);
}

/// Peak resident memory of each rank [GB].
std::vector<double> memory_by_rank() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double mine = 1024.0 * static_cast<double>(usage.ru_maxrss) / 1e9;
  return algebra::gathered(std::array{mine}, MPI_COMM_WORLD);
}

void report(const std::string& name, int degree, int size) {
  computation::Stopwatch watch;
  const computation::Result result = computation::solve(problem_of(name, degree, size), MPI_COMM_WORLD);
  const double solving = watch.lap();
  const auto directory = std::filesystem::temp_directory_path() / "plastron-contact-cost";
  workflow::write_output(result, {}, directory, "solution", MPI_COMM_WORLD);
  const double output = watch.lap();
  const std::vector<double> memory = memory_by_rank();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return;
  std::filesystem::remove_all(directory);

  fmt::print("\n{}, degree {}, {} rank(s), status {}\n", name, degree, result.ranks, contact::to_string(result.status));
  fmt::print("{:>9} {:>5} {:>7} | {:>6} {:>6} {:>6} {:>8} {:>8} {:>8} {:>6} {:>6} {:>7}\n", "unknowns", "steps",
             "factors", "mesh", "geom", "assem", "analysis", "factor", "iterate", "certif", "estim", "total");
  for (const computation::Level& l : result.levels)
    fmt::print("{:>9} {:>5} {:>7} | {:>6.2f} {:>6.2f} {:>6.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>6.2f} {:>6.2f} {:>7.2f}\n",
               l.unknowns, l.iterations, l.factorisations, l.seconds.mesh, l.seconds.discretisation, l.seconds.assembly,
               l.seconds.analysis, l.seconds.factorisation, l.seconds.iteration, l.seconds.certificate,
               l.seconds.estimates, l.seconds.total());
  const computation::Level& finest = result.levels.back();
  const double one = finest.seconds.factorisation / finest.factorisations;
  fmt::print("output {:.2f} s, the whole run {:.2f} s, peak memory by rank so far {:.2f} GB\n", output,
             solving + output, fmt::join(memory, " "));
  fmt::print("one factorisation {:.2f} s, the whole run {:.2f} factorisations\n", one, (solving + output) / one);
  std::fflush(stdout);
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv);
  std::vector<std::string> names{"cap", "barrel", "strip"};
  std::vector<int> degrees{2, 4}, sizes{0, 1, 2};
  if (argc > 1) names = {argv[1]};
  if (argc > 2) degrees = {std::atoi(argv[2])};
  if (argc > 3) sizes.clear();
  for (int i = 3; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  for (const std::string& name : names)
    for (const int degree : degrees)
      for (const int size : sizes) plastron::benchmarks::report(name, degree, size);
}
