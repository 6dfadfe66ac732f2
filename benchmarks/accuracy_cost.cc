// Measures the cost of an accuracy: meshes, unknowns and seconds to a tolerance of energy, reaction, contact area or deflection, and the true error then, for all
// problems with known answers. accuracy_cost [TOLERANCE [DEGREE [PART OF A NAME]]]; without arguments 1e-2, 1e-3 and 1e-4 at degree 4, the
// one of a case that gives none. ACCURACY_MESHES=1 tells of each mesh. Exit code 1 if a true error is above its tolerance.
#include "verification/reference_problems.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/computation/solve.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace plastron::benchmarks {
namespace {

using verification::ContactReference;
using verification::LinearReference;

struct KnownGoal {
  std::string name;
  double exact;
};

/// A problem with goals that are known, as the program computes them.
struct Known {
  std::string name;
  problem::Problem problem;
  std::vector<KnownGoal> goals;
  double least_tolerance = 0;  ///< that it is asked for, unless that is said
};

std::vector<Known> problems(int degree) {
  using verification::ShearCorrection;
  std::vector<Known> all;
  const auto pressed = [&](const ContactReference& r) {
    Known known{.name = r.name, .problem = r.problem, .goals = {{"energy", r.energy / r.factor}}};
    if (r.reaction > 0) known.goals.push_back({"reaction", r.reaction / r.factor});
    known.problem.probes.clear();
    all.push_back(known);
    if (r.boundaries.empty()) return;
    known.name += ", area";
    known.goals = {{"contact_area", verification::contact_area(r)}};
    known.least_tolerance = 1e-3;  // an edge is no better than its nodes are near
    all.push_back(std::move(known));
  };
  for (const std::string& name : verification::contact_reference_names())
    pressed(verification::contact_reference(name, degree, 0));
  pressed(verification::pressed_strip(1e-3, degree, 0));
  const auto deflected = [&](const LinearReference& r) {
    const char axis = std::abs(r.direction.x()) > 0.5 ? 'x' : 'z';
    const double sign = r.direction.sum();
    const std::string goal = fmt::format("probe.{}.u.{}", r.problem.probes.front().name, axis);
    all.push_back({r.name + ", deflection", r.problem, {{goal, sign * r.displacement}}});
  };
  for (const double e : {1e-2, 1e-3, 1e-4}) {
    const LinearReference r = verification::hyperbolic_paraboloid(e, ShearCorrection::one, false, degree, 0);
    all.push_back({r.name + ", energy", r.problem, {{"energy", *r.energy}}});
    deflected(r);
  }
  for (const double e : {0.1, 0.01}) deflected(verification::free_hyperboloid(e, ShearCorrection::one, degree, 0));
  deflected(verification::scordelis_lo(ShearCorrection::one, true, degree, 0));
  return all;
}

void print_goals(const Known& known, const std::vector<estimation::GoalRecord>& goals) {
  for (std::size_t g = 0; g < goals.size(); ++g) {
    const double exact = known.goals[g].exact, error = exact - goals[g].value;
    fmt::print("  {:>9.2e} {:>9.2e} {:>6.2f}", error / exact, goals[g].error / std::abs(exact),
               goals[g].error / std::abs(error));
  }
}

/// Whether a run ended below its tolerance, in truth.
bool report(Known known, double tolerance) {
  problem::Accuracy accuracy;
  for (const KnownGoal& goal : known.goals) accuracy.goals.push_back({goal.name, tolerance});
  known.problem.accuracy = accuracy;
  if (!std::getenv("ACCURACY_WITHOUT_LAYERS")) known.problem.discretisation.layers = problem::Layers::automatic;
  const computation::Stopwatch watch;
  const computation::Result result = computation::solve(known.problem, MPI_COMM_WORLD);
  const double seconds = watch.seconds();
  const computation::Level& last = result.levels.back();
  bool is_true = result.status == contact::Status::solved;
  for (std::size_t g = 0; g < last.goals.size(); ++g)
    is_true = is_true && std::abs(last.goals[g].value / known.goals[g].exact - 1) <= tolerance;
  fmt::print("{:<42} {:>6.0e} {:>6} {:>6} {:>8} {:>7.2f}", known.name, tolerance, known.problem.discretisation.degree,
             result.levels.size(), last.unknowns, seconds);
  print_goals(known, last.goals);
  if (result.status != contact::Status::solved) fmt::print("  {}", contact::to_string(result.status));
  fmt::print("{}\n", is_true ? "" : "  MISSED");
  if (std::getenv("ACCURACY_MESHES"))
    for (const computation::Level& level : result.levels) {
      fmt::print("    {:>6} cells {:>8} unknowns {:>6.3f} s", level.cells, level.unknowns, level.seconds.total());
      print_goals(known, level.goals);
      fmt::print("\n");
    }
  std::fflush(stdout);
  return is_true;
}

}  // namespace
}  // namespace plastron::benchmarks

int main(int argc, char** argv) {
  const plastron::algebra::Session session(argc, argv);
  const int degree = argc > 2 ? std::atoi(argv[2]) : 4;
  const std::string part = argc > 3 ? argv[3] : "";
  std::vector<double> tolerances{1e-2, 1e-3, 1e-4};
  if (argc > 1) tolerances = {std::atof(argv[1])};
  fmt::print("{:<42} {:>6} {:>6} {:>6} {:>8} {:>7}  of each goal: true, estimated, ratio\n", "problem", "asked",
             "degree", "meshes", "unknowns", "seconds");
  bool are_true = true;
  for (const plastron::benchmarks::Known& known : plastron::benchmarks::problems(degree))
    if (known.name.find(part) != std::string::npos)
      for (const double tolerance : tolerances)
        if ((argc > 1 || tolerance >= known.least_tolerance) && !plastron::benchmarks::report(known, tolerance))
          are_true = false;
  return are_true ? 0 : 1;
}
