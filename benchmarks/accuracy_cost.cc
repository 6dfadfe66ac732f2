// What an accuracy costs: meshes, unknowns and seconds to a tolerance of energy and reaction, and the true error then, for all problems with
// known answers. accuracy_cost [TOLERANCE [DEGREE [PART OF A NAME]]]; without arguments 1e-2, 1e-3 and 1e-4.
#include "verification/reference_problems.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/computation/stopwatch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace plastron::benchmarks {
namespace {

using verification::ContactReference;
using verification::LinearReference;

/// A problem whose energy is known, and its reaction where there is contact, as the program computes them.
struct Known {
  std::string name;
  computation::Problem problem;
  double energy, reaction = 0;
};

std::vector<Known> problems(int degree) {
  std::vector<Known> all;
  for (const std::string& name : verification::contact_reference_names()) {
    ContactReference r = verification::contact_reference(name, degree, 0);
    all.push_back({name, r.problem, r.energy / r.factor, r.reaction / r.factor});
  }
  for (const double e : {1e-2, 1e-3}) {
    LinearReference r = verification::hyperbolic_paraboloid(e, verification::ShearCorrection::one, false, degree, 0);
    all.push_back({r.name, r.problem, *r.energy});
  }
  return all;
}

void report(Known known, double tolerance) {
  computation::Accuracy accuracy{.goals = {{"energy", tolerance}}};
  if (known.reaction > 0) accuracy.goals.push_back({"reaction", tolerance});
  known.problem.accuracy = accuracy;
  if (!std::getenv("ACCURACY_WITHOUT_LAYERS")) known.problem.discretisation.layers = computation::Layers::automatic;
  known.problem.probes.clear();
  const computation::Stopwatch watch;
  const computation::Result result = computation::solve(known.problem, MPI_COMM_WORLD);
  const double seconds = watch.seconds();
  const computation::Level& last = result.levels.back();
  fmt::print("{:<32} {:>6.0e} {:>6} {:>8} {:>7.2f}", known.name, tolerance, result.levels.size(), last.unknowns,
             seconds);
  for (const computation::GoalRecord& goal : last.goals) {
    const double exact = goal.name == "energy" ? known.energy : known.reaction;
    fmt::print("  {:>9.2e} {:>9.2e} {:>6.2f}", (exact - goal.value) / exact, goal.error / exact,
               goal.error / std::abs(exact - goal.value));
  }
  fmt::print("  {}\n", result.status == contact::Status::solved ? "" : contact::to_string(result.status));
  std::fflush(stdout);
  if (!std::getenv("ACCURACY_MESHES")) return;
  for (const computation::Level& level : result.levels) {
    fmt::print("    {:>6} cells {:>8} unknowns {:>6.3f} s", level.cells, level.unknowns, level.seconds.total());
    for (const computation::GoalRecord& goal : level.goals) {
      const double exact = goal.name == "energy" ? known.energy : known.reaction;
      fmt::print("  {:>9.2e} {:>9.2e}", (exact - goal.value) / exact, goal.error / exact);
    }
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv);
  const int degree = argc > 2 ? std::atoi(argv[2]) : 4;
  const std::string part = argc > 3 ? argv[3] : "";
  std::vector<double> tolerances{1e-2, 1e-3, 1e-4};
  if (argc > 1) tolerances = {std::atof(argv[1])};
  fmt::print("{:<32} {:>6} {:>6} {:>8} {:>7}  energy: true, estimated, ratio; reaction likewise\n", "problem", "asked",
             "meshes", "unknowns", "seconds");
  for (const plastron::benchmarks::Known& known : plastron::benchmarks::problems(degree))
    if (known.name.find(part) != std::string::npos)
      for (const double tolerance : tolerances) plastron::benchmarks::report(known, tolerance);
}
