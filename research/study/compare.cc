// All formulations on one mesh sequence, side by side (docs/research/compare.md).
#include <plastron/computation/solve.hpp>
#include <research/study/measures.hpp>
#include <research/study/studies.hpp>
#include <research/study/variations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::study {

namespace {

using element::Formulation;

/// One formulation on all meshes; the fields of the tangent one serve as reference for the others.
struct Run {
  contact::Status status = contact::Status::solved;
  std::vector<computation::Level> levels{};
  std::vector<algebra::Vector> fields{};  ///< (u, r) at the nodes of each mesh
  std::vector<double> distance{};         ///< energy norm of the difference from the tangent one, relative
  double noise = 0;                       ///< of such a difference on the finest mesh
};

Run solve_with(problem::Problem problem, const Run* tangent, MPI_Comm comm, computation::Observer observer) {
  problem.probes.clear();
  Run run;
  observer.solution = [&](int level, const computation::Solution& solution) {
    const auto at = static_cast<std::size_t>(level);
    run.distance.push_back(tangent && at < tangent->fields.size()
                               ? relative_distance(solution.discrete->shell, solution.nodal.y, tangent->fields[at])
                               : no_value);
    if (!tangent) run.fields.push_back(solution.nodal.y);
    run.noise = relative_noise(solution, std::sqrt(2 * solution.discrete->shell.energies(solution.nodal.y).total()));
  };
  const computation::Result result = computation::solve(problem, comm, observer);
  run.status = result.status;
  run.levels = result.levels;
  return run;
}

void add_rows(const Run& run, const Run& tangent, Formulation formulation, Table& table) {
  for (std::size_t l = 0; l < run.levels.size(); ++l) {
    const computation::Level& level = run.levels[l];
    const bool is_tangent = formulation == Formulation::tangent;
    const bool comparable = !is_tangent && l < tangent.levels.size();
    table.rows.push_back({std::string(element::to_string(formulation)), static_cast<std::int64_t>(l), level.unknowns,
                          level.energy, level.reaction, level.contact_area, level.max_normal_rotation,
                          formulation == Formulation::mixed ? level.multiplier_norm : no_value,
                          static_cast<std::int64_t>(level.iterations), level.seconds.total(),
                          comparable ? relative_difference(level.energy, tangent.levels[l].energy) : no_value,
                          comparable ? relative_difference(level.reaction, tangent.levels[l].reaction) : no_value,
                          l < run.distance.size() ? run.distance[l] : no_value});
  }
}

void add_series(const Run& run, Formulation formulation, io::Plot& plot) {
  io::Series series{.label = std::string(element::to_string(formulation)), .x = {}, .y = {}};
  for (std::size_t l = 0; l < run.levels.size() && l < run.distance.size(); ++l) {
    series.x.push_back(static_cast<double>(run.levels[l].unknowns));
    series.y.push_back(run.distance[l]);
  }
  plot.series.push_back(std::move(series));
}

/// Why a difference from the tangent solution says nothing; empty if it says something.
std::string nothing_to_compare(const Run& run, const Run& tangent) {
  if (tangent.status != contact::Status::solved || tangent.levels.empty())
    return "the tangent formulation has no solution";
  if (run.distance.size() < 2) return "one mesh shows no approach; take more refinements";
  if (!(tangent.noise < too_noisy)) return "the solution has no energy beyond rounding";
  const double noise = std::max(run.noise, tangent.noise);
  if (last_step_above(run.distance, noise) == 0)
    return fmt::format("the difference is {:.1e} on the finest mesh, and less than {:.0e} is noise",
                       run.distance.back(), noise);
  return "";
}

/// Both solutions have errors of the method's order, so their difference falls at least like the worst order there is, that
/// of solutions with corners: h^{1/2}. Judged between the finest two meshes where it is more than noise.
Claim closes_in(const Run& run, const Run& tangent, Formulation formulation) {
  constexpr double least_order = 0.5;
  const std::string statement =
      fmt::format("{}: the difference from the tangent solution falls like h^{:.1f} or faster",
                  element::to_string(formulation), least_order);
  if (const std::string why = nothing_to_compare(run, tangent); !why.empty()) return not_judged(statement, why);
  const std::size_t fine = last_step_above(run.distance, std::max(run.noise, tangent.noise));
  const double rate = std::log2(run.distance[fine - 1] / run.distance[fine]);
  return judged(statement,
                fmt::format("{:.1e} on mesh {}, {:.1e} on mesh {}: h^{:.2f}", run.distance[fine - 1], fine - 1,
                            run.distance[fine], fine, rate),
                rate >= least_order);
}

/// The penalised solution has another limit, which p sets: the mesh should be what one sees.
Claim is_within_the_mesh_error(const Run& run, const Run& tangent) {
  const std::string statement =
      "penalised: p changes the energy on the finest mesh by less than the last refinement does";
  if (const std::string why = nothing_to_compare(run, tangent); !why.empty()) return not_judged(statement, why);
  const std::size_t finest = tangent.levels.size() - 1;
  const double by_p = std::abs(relative_difference(run.levels.back().energy, tangent.levels[finest].energy));
  const double by_mesh =
      std::abs(relative_difference(tangent.levels[finest - 1].energy, tangent.levels[finest].energy));
  return judged(statement, fmt::format("{:.1e} by p, {:.1e} by the mesh", by_p, by_mesh), by_p < by_mesh);
}

}  // namespace

Report compare(const problem::Problem& problem, const StudyOptions&, MPI_Comm comm, const StudyObserver& observer) {
  Report report{.table = {.name = "compare",
                          .title = "Do all formulations give the same answer, and at what price?",
                          .columns = {{"formulation", "", "-"},
                                      {"level", "", "1"},
                                      {"unknowns", "", "1"},
                                      {"energy", "1/2 a(U,U)", "J"},
                                      {"reaction", "|R|", "N"},
                                      {"contact area", "", "m^2"},
                                      {"normal_rotation", "max |r.a3|", "1"},
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
    const std::string name(element::to_string(formulation));
    if (const std::string why = refusal(problem, formulation); !why.empty()) {
      report.table.remarks.push_back(fmt::format("{} left out: {}", name, why));
      continue;
    }
    if (observer.stage) observer.stage(name);
    Run run = solve_with(in_formulation(problem, formulation), formulation == Formulation::tangent ? nullptr : &tangent,
                         comm, observer.solve);
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
    report.table.claims.push_back(formulation == Formulation::penalised ? is_within_the_mesh_error(run, tangent)
                                                                        : closes_in(run, tangent, formulation));
  }
  report.table.remarks.push_back(
      "differences are relative to the tangent formulation on the same mesh; p = " +
      fmt::format("{:g}, rho = {:g}", problem.shell.tangency.penalty, problem.shell.tangency.stabilisation));
  return report;
}

}  // namespace plastron::study
