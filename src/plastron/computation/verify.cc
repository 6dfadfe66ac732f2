#include <plastron/computation/verify.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/path.hpp>
#include <plastron/computation/warnings.hpp>
#include <plastron/meshing/sequence.hpp>
#include <plastron/problem/instants.hpp>
#include <plastron/solution/summary.hpp>

#include <algorithm>
#include <iterator>
#include <set>

namespace plastron::computation {

namespace {

/// Divides cells that are larger than the requested cells, until there are no more or the mesh has more cells than
/// requested.
void refine_to(std::span<const fem::CellPlace> cells, fem::MeshSequence& meshes) {
  const std::set<fem::CellPlace> wanted(cells.begin(), cells.end());
  const auto total = static_cast<std::int64_t>(cells.size());
  for (bool goes_on = true; goes_on && meshes.space()->global_cells < total;) {
    const fem::Space& space = *meshes.space();
    std::vector<signed char> marks;
    for (std::size_t c = 0; c < space.owned_cells; ++c)
      marks.push_back(wanted.contains(fem::place_of(space.cells[c])) ? 0 : 1);
    goes_on = algebra::sum_over_ranks(std::int64_t{std::ranges::count(marks, 1)}, space.layout->comm) > 0;
    if (goes_on) meshes.refine({}, marks);
  }
}

}  // namespace

FinestMesh finest_mesh(const problem::Problem& problem, MPI_Comm comm, const MeshCells& cells) {
  fem::MeshSequence meshes = meshing::mesh_sequence(problem, comm);
  if (!cells.cuts.empty()) meshes.begin_with_cuts(cells.cuts);
  if (problem.accuracy)
    refine_to(cells.places, meshes);
  else
    for (int number = 0; number < problem.discretisation.refinements; ++number) meshes.refine({});
  return {.space = meshes.space(),
          .surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts)};
}

Result measured_result(const problem::Problem& problem, Solution found) {
  const certificate::Verdict verdict = certificate::certify(*found.discrete, found.nodal);
  Result result{.summary = verdict.summary,
                .certificate = verdict.certificate,
                .levels = {measured(*found.discrete, found.nodal, verdict)},
                .has_obstacle = !problem.shell.obstacles.empty(),
                .formulation = problem.shell.tangency.formulation,
                .rotations = problem.shell.rotations};
  MPI_Comm_size(found.discrete->space().layout->comm, &result.ranks);
  take_moments_about(problem.output.moment_point, result.summary);
  choose_recovery(problem.output, found);
  result.probes = probe(found, problem.probes);
  result.solution = std::move(found);
  find_stress_peak(result);
  return result;
}

Verification verify(const problem::Problem& problem, const FinestMesh& mesh, StoredSolution solution) {
  const problem::Instant last = problem::instants(problem).back();
  solution.state.control = problem::control_of(problem, last, 0);
  const double controlled = solution.state.factors.loads;
  solution.state.factors.forces = last.factors.forces;
  solution.state.factors.named = last.factors.named;
  solution.state.factors.released = last.factors.released;
  if (solution.state.control) {
    solution.state.factors.loads = last.factors.loads;
    solution.state.factors.controlled(solution.state.control->factor) = controlled;
  }
  Solution found{.discrete = assembly::discretise(mesh.space, mesh.surface, problem.shell, std::move(solution.state)),
                 .nodal = std::move(solution.nodal)};
  std::vector<double> ways;
  for (const std::size_t k : pressed_obstacles(*found.discrete)) ways.push_back(solution.ways.at(k));
  press(*found.discrete, ways);
  Verification verification{.result = measured_result(problem, std::move(found))};
  Result& result = verification.result;
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  if (has_path_to_prove(discrete.obstacles)) {
    std::vector<certificate::Station> stations(1);
    std::ranges::move(solution.path, std::back_inserter(stations));
    stations.push_back(station_of(discrete, result.solution->nodal.y));
    result.passing = proven_again(discrete, stations);
  }
  judge_certificate(result);
  examine_stability(result, *result.solution);
  verification.membership =
      membership_rows(problem, *result.solution->discrete, result.solution->nodal, result.summary);
  if (!problem.steps.empty()) {
    const assembly::State& state = result.solution->discrete->state;
    result.history.push_back({.step = problem.steps.back().name,
                              .factors = state.factors,
                              .factor_names = problem.factor_names,
                              .controlled_displacement = controlled_displacement(state),
                              .status = result.status,
                              .level = result.levels.back(),
                              .summary = result.summary,
                              .probes = result.probes,
                              .stability = result.stability});
  }
  add_contact_zones(result);
  return verification;
}

}  // namespace plastron::computation
