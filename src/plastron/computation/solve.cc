// The story, top to bottom:
//   find U in K with a(U, V - U) >= l(V - U) for all V in K              (M17, M18), without obstacle (M11)
// on a sequence of nested meshes. On each: the nodal coordinates make K a box, the active set of the mesh before
// is the first guess, and the finest solution is certified from its strains and bounds.
#include <plastron/computation/solve.hpp>

#include <plastron/certificate/contact_zones.hpp>
#include <plastron/computation/description.hpp>
#include <plastron/computation/doubts.hpp>
#include <plastron/computation/level.hpp>
#include <plastron/computation/locking.hpp>
#include <plastron/computation/memory.hpp>
#include <plastron/computation/point_supports.hpp>
#include <plastron/computation/probes.hpp>
#include <plastron/computation/stopwatch.hpp>

#include <algorithm>
#include <array>

namespace plastron::computation {

namespace {

/// Whether the supports alone hold the shell: then the active set's first step on the coarsest mesh went through with nothing in
/// contact. Other solvers' first steps say nothing of the kind.
bool supports_hold(const Level& coarsest, contact::Solver solver) {
  return solver == contact::Solver::active_set && !coarsest.history.empty() && coarsest.history.front().active == 0;
}

bool nothing_to_refine(contact::Status status) {
  return status == contact::Status::infeasible || status == contact::Status::singular ||
         status == contact::Status::not_finite;
}

/// Adds what is new and tells the observer of it.
void warn(std::vector<std::string> warnings, const Observer& observer, Result& result) {
  for (std::string& text : warnings) {
    if (std::ranges::find(result.warnings, text) != result.warnings.end()) continue;
    if (observer.warning) observer.warning(text);
    result.warnings.push_back(std::move(text));
  }
}

void add_contact_zones(Result& result) {
  auto zones = certificate::contact_zones(*result.solution->discrete, result.solution->nodal);
  for (std::size_t k = 0; k < zones.size(); ++k) result.summary.obstacles[k].zones = std::move(zones[k]);
}

}  // namespace

Result solve(const Problem& problem, MPI_Comm comm, const Observer& observer) {
  const assembly::ShellDescription shell = shell_description(problem);
  Result result{.has_obstacle = !problem.obstacles.empty(),
                .formulation = problem.discretisation.tangency.formulation,
                .warnings = locking_warnings(problem)};
  MPI_Comm_size(comm, &result.ranks);
  bool is_beyond_linear = false;
  Stopwatch watch;
  fem::MeshSequence meshes = mesh_sequence(problem, comm);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);

  for (int number = 0; number <= problem.discretisation.refinements; ++number) {
    result.status = contact::Status::interrupted;
    if (wants_to_stop(observer, comm)) break;
    LevelTask task{.number = number, .settings = problem.contact, .linearisation = problem.linearisation};
    if (number > 0) {
      std::array fields{result.solution->nodal.touching, result.solution->nodal.y};
      const bool was_deformed = result.solution->discrete->state.is_deformed();
      if (!observer.stop) result.solution.reset();  // one mesh at a time in memory, unless this may be the last one
      meshes.refine(std::span(fields).first(was_deformed ? 2 : 1));
      task.touched = std::move(fields[0]);
      if (was_deformed) {
        task.start.displacement = std::move(fields[1]);
        task.start.displacement.update_ghosts();
      }
    }
    task.space = meshes.space();
    if (number > 0 && supports_hold(result.levels.front(), problem.contact.solver))
      task.settings.detect_free_motions = false;
    task.seconds_for_mesh = watch.lap();
    LevelResult level = solve_level(std::move(task), shell, surface, observer);
    if (level.record.status == contact::Status::interrupted) break;  // what there is of the mesh before is the result
    if (observer.level) observer.level(number, level.record);
    if (observer.solution) observer.solution(number, level.solution);
    result.status = level.record.status;
    result.summary = level.verdict.summary;
    result.certificate = level.verdict.certificate;
    result.levels.push_back(std::move(level.record));
    result.solution = std::move(level.solution);
    if (!is_beyond_linear) {
      auto warnings = linear_model_warnings(result.summary);
      is_beyond_linear = !warnings.empty();
      warn(std::move(warnings), observer, result);
    }
    if (nothing_to_refine(result.status)) break;
    watch.lap();
  }
  if (result.solution) {
    judge_certificate(result);
    warn(contact_warnings(result, problem.contact), observer, result);
    warn(point_support_warnings(result, problem.supports), observer, result);
    add_contact_zones(result);
    result.probes = probe(*result.solution, problem.probes);
  }
  result.peak_memory = peak_memory(comm);
  return result;
}

}  // namespace plastron::computation
