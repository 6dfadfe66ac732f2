// Cost of the R4 cap (e = 0.02) by phase: cap_cost [DEGREE REFINEMENTS]; about 400 000 unknowns at degree 2 and 4 without
// arguments. The two claims of docs/performance.md are its last lines.
#include "cap.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/computation/stopwatch.hpp>
#include <plastron/io/output.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <cstdlib>
#include <filesystem>

namespace plastron::benchmarks {
namespace {

void report(int degree, int refinements) {
  computation::Stopwatch watch;
  const computation::Result result = computation::solve(cap(0.02, degree, refinements), MPI_COMM_WORLD);
  const double solving = watch.lap();
  const auto directory = std::filesystem::temp_directory_path() / "plastron-cap-cost";
  io::write_output(result, {}, directory, "solution", MPI_COMM_WORLD);
  const double output = watch.lap();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) return;
  std::filesystem::remove_all(directory);

  fmt::print("\ncap, e = 0.02, degree {}, {} rank(s), status {}\n", degree, result.ranks,
             contact::to_string(result.status));
  fmt::print("{:>9} {:>5} | {:>6} {:>6} {:>6} {:>8} {:>8} {:>8} {:>6} {:>7}\n", "unknowns", "steps", "mesh", "geom",
             "assem", "analysis", "factor", "iterate", "certif", "total");
  for (const computation::Level& l : result.levels)
    fmt::print("{:>9} {:>5} | {:>6.2f} {:>6.2f} {:>6.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>6.2f} {:>7.2f}\n", l.unknowns,
               l.iterations, l.seconds.mesh, l.seconds.discretisation, l.seconds.assembly, l.seconds.analysis,
               l.seconds.factorisation, l.seconds.iteration, l.seconds.certificate, l.seconds.total());
  const computation::Level& finest = result.levels.back();
  const double one = finest.seconds.factorisation / finest.factorisations;
  const double beside = finest.seconds.mesh + finest.seconds.discretisation + finest.seconds.assembly +
                        finest.seconds.certificate + output;
  fmt::print("output {:.2f} s, peak memory {:.2f} GB, one factorisation {:.2f} s\n", output, result.peak_memory / 1e9,
             one);
  fmt::print("finest level, mesh + geometry + assembly + certificate + output: {:.2f} factorisations\n", beside / one);
  fmt::print("whole run: {:.2f} factorisations\n", (solving + output) / one);
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv);
  if (argc == 3) {
    plastron::benchmarks::report(std::atoi(argv[1]), std::atoi(argv[2]));
  } else {
    plastron::benchmarks::report(2, 6);
    plastron::benchmarks::report(4, 5);
  }
}
