// All contact solvers on one mesh sequence, side by side (docs/research/compare.md).
#include <plastron/computation/solve.hpp>
#include <research/referees/solvers.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>

#include <fmt/format.h>

#include <cmath>

namespace plastron::study {

namespace {

/// The results of one solver on all meshes.
struct Run {
  std::string name;
  contact::Status status = contact::Status::solved;
  std::string missed{};  ///< rows of the certificate beyond their limits
  bool has_level = false;
  std::int64_t iterations = 0, safeguarded = 0, linear_steps = 0, factorisations = 0;
  double seconds = 0;        ///< of the contact solution: factorisations and the rest of the iteration
  double energy = no_value;  ///< of the finest mesh
};

Run solve_with(const referees::NamedSolver& solver, problem::Problem problem, MPI_Comm comm,
               const computation::Observer& observer) {
  problem.contact.solver = solver.solve;
  const computation::Result result = computation::solve(problem, comm, observer);
  Run run{.name = solver.name,
          .status = result.status,
          .missed = result.missed_limits,
          .has_level = !result.levels.empty()};
  for (const computation::Level& level : result.levels) {
    run.iterations += level.iterations;
    run.factorisations += level.factorisations;
    run.seconds += level.seconds.factorisation + level.seconds.iteration;
    for (const contact::Iteration& iteration : level.history) {
      run.safeguarded += iteration.safeguarded;
      run.linear_steps += iteration.linear_steps;
    }
  }
  if (run.has_level) run.energy = result.levels.back().energy;
  return run;
}

bool has_solution(const Run& run) {
  return run.has_level && (run.status == contact::Status::solved || run.status == contact::Status::inaccurate);
}

std::string certificate_of(const Run& run) {
  if (!has_solution(run)) return std::string(contact::to_string(run.status));
  return run.status == contact::Status::solved ? "holds" : "missed";
}

void add_row(const Run& run, const Run& first, Table& table) {
  table.rows.push_back({run.name, run.seconds, run.iterations, run.safeguarded, run.linear_steps, run.factorisations,
                        run.energy, run.name == first.name ? no_value : relative_difference(run.energy, first.energy),
                        certificate_of(run)});
}

Claim finds_the_same(const Run& run, const Run& first) {
  constexpr double agreement = 1e-8;
  const std::string statement =
      fmt::format("{} finds the energy of {} to {:.0e}, relative", run.name, first.name, agreement);
  if (!has_solution(first)) return not_judged(statement, first.name + " has no solution");
  if (!has_solution(run)) return judged(statement, std::string(contact::to_string(run.status)), false);
  const double difference = std::abs(relative_difference(run.energy, first.energy));
  return judged(statement, fmt::format("{:.1e}", difference), difference <= agreement);
}

Claim is_certified(const Run& run) {
  const std::string statement = run.name + " finds a solution whose certificate holds";
  const bool holds = run.status == contact::Status::solved;
  return judged(statement,
                holds                ? "all rows"
                : run.missed.empty() ? std::string(contact::to_string(run.status))
                                     : run.missed,
                holds);
}

Report empty_report() {
  return {.table = {.name = "compare-solvers",
                    .title = "Do all contact solvers give the same answer, and at what price?",
                    .columns = {{"solver", "", "-"},
                                {"time", "", "s"},
                                {"iterations", "", "1"},
                                {"safeguarded", "", "1"},
                                {"linear steps", "", "1"},
                                {"factorisations", "", "1"},
                                {"energy", "1/2 a(U,U)", "J"},
                                {"energy diff", "", "1"},
                                {"certificate", "", "-"}}},
          .plot = {.title = "Time of the contact solution by solver, in the table's order",
                   .x = {"solver", false},
                   .y = {"seconds", true}}};
}

}  // namespace

Report compare_solvers(const problem::Problem& problem, const StudyOptions&, MPI_Comm comm,
                       const StudyObserver& observer) {
  Report report = empty_report();
  Run first;
  for (const referees::NamedSolver& solver : referees::all_solvers) {
    if (observer.stage) observer.stage(solver.name);
    const Run run = solve_with(solver, problem, comm, observer.solve);
    const bool is_first = report.table.rows.empty();
    if (is_first) first = run;
    add_row(run, first, report.table);
    report.plot.series.push_back(
        {.label = run.name, .x = {static_cast<double>(report.table.rows.size())}, .y = {run.seconds}});
    if (run.status != contact::Status::solved) {
      report.table.remarks.push_back(fmt::format("{}: {}", run.name, contact::explain(run.status)));
      if (report.status == contact::Status::solved) report.status = run.status;
      if (run.status == contact::Status::interrupted) break;
    }
    if (!is_first) report.table.claims.push_back(finds_the_same(run, first));
    report.table.claims.push_back(is_certified(run));
  }
  report.table.remarks.emplace_back(
      "time, iterations, steps and factorisations are of the contact solution, summed over all meshes");
  return report;
}

}  // namespace plastron::study
