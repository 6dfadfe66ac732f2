#include <plastron/study/compare.hpp>

#include <plastron/study/examine.hpp>
#include <plastron/study/solve.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

using assembly::Formulation;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// One formulation on all meshes; the fields of the tangent one serve as reference for the others.
struct Run {
  contact::Status status = contact::Status::solved;
  std::vector<Level> levels{};
  std::vector<algebra::Vector> fields{};  ///< (u, r) at the nodes of each mesh
  std::vector<double> distance{};         ///< energy norm of the difference from the tangent one, relative
};

/// || y - reference ||_a / || reference ||_a
double relative_distance(const assembly::ShellOperator& shell, algebra::Vector y, const algebra::Vector& reference) {
  const double scale = shell.energies(reference).total();
  for (std::size_t i = 0; i < y.local().size(); ++i) y.local()[i] -= reference.local()[i];
  const double difference = shell.energies(y).total();
  return scale > 0 ? std::sqrt(difference / scale) : std::sqrt(2 * difference);
}

Run solve_with(Problem problem, Formulation formulation, const Run* tangent, MPI_Comm comm, Observer observer) {
  problem.discretisation.tangency.formulation = formulation;
  problem.probes.clear();
  Run run;
  observer.solution = [&](int level, const Solution& solution) {
    const auto at = static_cast<std::size_t>(level);
    run.distance.push_back(tangent && at < tangent->fields.size()
                               ? relative_distance(solution.discrete->shell, solution.nodal.y, tangent->fields[at])
                               : nothing);
    if (!tangent) run.fields.push_back(solution.nodal.y);
  };
  const Result result = solve(problem, comm, observer);
  run.status = result.status;
  run.levels = result.levels;
  return run;
}

/// Why the formulation cannot be used on this case; empty if it can.
std::string refusal(Problem problem, Formulation formulation) {
  problem.discretisation.tangency.formulation = formulation;
  for (const Finding& finding : examine(problem))
    if (finding.severity == Severity::error) return finding.text;
  return "";
}

double relative(double value, double reference) {
  return reference != 0 ? value / reference - 1 : value == 0 ? 0 : nothing;
}

void add_rows(const Run& run, const Run& tangent, Formulation formulation, Table& table) {
  for (std::size_t l = 0; l < run.levels.size(); ++l) {
    const Level& level = run.levels[l];
    const bool is_tangent = formulation == Formulation::tangent;
    const bool comparable = !is_tangent && l < tangent.levels.size();
    table.rows.push_back({std::string(assembly::to_string(formulation)), static_cast<std::int64_t>(l), level.unknowns,
                          level.energy, level.reaction, level.contact_area, level.max_tilt,
                          formulation == Formulation::mixed ? level.multiplier_norm : nothing,
                          static_cast<std::int64_t>(level.iterations), level.seconds.total(),
                          comparable ? relative(level.energy, tangent.levels[l].energy) : nothing,
                          comparable ? relative(level.reaction, tangent.levels[l].reaction) : nothing,
                          l < run.distance.size() ? run.distance[l] : nothing});
  }
}

void add_series(const Run& run, Formulation formulation, Plot& plot) {
  Series series{.label = std::string(assembly::to_string(formulation)), .x = {}, .y = {}};
  for (std::size_t l = 0; l < run.levels.size() && l < run.distance.size(); ++l) {
    series.x.push_back(static_cast<double>(run.levels[l].unknowns));
    series.y.push_back(run.distance[l]);
  }
  plot.series.push_back(std::move(series));
}

Claim closes_in(const Run& run, Formulation formulation) {
  const double first = run.distance.front(), last = run.distance.back();
  constexpr double rounding = 1e-8;
  const bool is_penalised = formulation == Formulation::penalised;
  return {.statement = fmt::format("{}: the solution approaches that of the tangent formulation under refinement{}",
                                   assembly::to_string(formulation), is_penalised ? ", down to what p leaves" : ""),
          .measured = fmt::format(
              "relative difference in the energy norm {:.1e} on the coarsest, {:.1e} on the finest mesh", first, last),
          .holds = last < first || last < rounding};
}

}  // namespace

Report compare(const Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  Report report{.table = {.name = "compare",
                          .title = "Do all formulations give the same answer, and at what price?",
                          .columns = {{"formulation", "", "-"},
                                      {"level", "", "1"},
                                      {"unknowns", "", "1"},
                                      {"energy", "1/2 a(U,U)", "J"},
                                      {"reaction", "|R|", "N"},
                                      {"contact area", "", "m^2"},
                                      {"tilt", "max |r.a3|", "1"},
                                      {"multiplier", "|grad lambda|", "N m"},
                                      {"steps", "", "1"},
                                      {"time", "", "s"},
                                      {"energy diff", "", "1"},
                                      {"reaction diff", "", "1"},
                                      {"distance", "|U - U_t|_a", "1"}}},
                .plot = {.title = "Difference from the tangent formulation on the same mesh",
                         .x = {"unknowns", true},
                         .y = {"relative difference in the energy norm", true}}};
  Run tangent;
  for (const Formulation formulation :
       {Formulation::tangent, Formulation::penalised, Formulation::mixed, Formulation::classical}) {
    const std::string name(assembly::to_string(formulation));
    if (const std::string why = refusal(problem, formulation); !why.empty()) {
      report.table.remarks.push_back(fmt::format("{} left out: {}", name, why));
      continue;
    }
    if (observer.stage) observer.stage(name);
    Run run = solve_with(problem, formulation, formulation == Formulation::tangent ? nullptr : &tangent, comm,
                         observer.solve);
    if (formulation == Formulation::tangent) tangent = run;
    add_rows(run, tangent, formulation, report.table);
    if (run.status != contact::Status::solved) {
      report.table.remarks.push_back(fmt::format("{} not solved: {}", name, contact::explain(run.status)));
      report.status = run.status;
      if (run.status == contact::Status::interrupted) break;
      continue;
    }
    if (formulation == Formulation::tangent) continue;
    add_series(run, formulation, report.plot);
    if (run.distance.size() > 1) report.table.claims.push_back(closes_in(run, formulation));
  }
  report.table.remarks.push_back("differences are relative to the tangent formulation on the same mesh; p = " +
                                 fmt::format("{:g}, rho = {:g}", problem.discretisation.tangency.penalty,
                                             problem.discretisation.tangency.stabilisation));
  return report;
}

}  // namespace plastron::study
