// The story, top to bottom:
//   find U in K with a(U, V - U) >= l(V - U) for all V in K                                        (M17, M18)
// on a sequence of nested meshes. On each: the nodal coordinates make K a box, the active set of the mesh before
// is the first guess, and the finest solution is certified from its strains and bounds.
#include <plastron/study/solve.hpp>

#include <plastron/assembly/stiffness.hpp>
#include <plastron/contact/primal_dual_active_set.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/study/memory.hpp>
#include <plastron/study/probes.hpp>
#include <plastron/study/stopwatch.hpp>

#include <array>

namespace plastron::study {

namespace {

assembly::ShellDescription describe(const Problem& problem) {
  assembly::ShellDescription shell{.thickness = problem.thickness,
                                   .material = problem.material,
                                   .tying = problem.discretisation.tying,
                                   .supports = problem.supports,
                                   .area_loads = problem.area_loads,
                                   .edge_loads = problem.edge_loads,
                                   .gap = {}};
  if (problem.obstacle)
    shell.gap = [o = *problem.obstacle](const Eigen::Vector3d& phi, const Eigen::Vector3d& a3, double thickness) {
      return obstacle::gap_at(o.half_space, o.face, phi, a3, thickness);
    };
  return shell;
}

/// Nodes of the new mesh that lie in the contact zone of the mesh before start in contact.
std::vector<contact::Activity> first_guess(const assembly::DiscreteShell& discrete, const algebra::Vector& touched) {
  std::vector<contact::Activity> activity(5 * static_cast<std::size_t>(discrete.space().layout->owned),
                                          contact::Activity::free);
  for (std::size_t i = 0; i < touched.owned().size(); ++i)
    if (discrete.coordinates.touchable[i] && touched.owned()[i] > 0.5) activity[5 * i] = contact::Activity::at_lower;
  return activity;
}

/// A support holds the touching face inside of the obstacle: K is empty. No bound says so, for nothing can move there.
bool held_inside_obstacle(const assembly::DiscreteShell& discrete) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  std::int64_t held = 0;
  for (std::size_t i = 0; i < coordinates.gaps.size(); ++i)
    if (!coordinates.touchable[i] && coordinates.bound_gap[i] < -1e-12 * (1 + discrete.points[i].phi.norm())) ++held;
  return algebra::sum_over_ranks(held, discrete.space().layout->comm) > 0;
}

struct LevelResult {
  Level record;
  Solution solution;
  assembly::Verdict verdict;
};

/// One mesh. `touched` holds the contact zone of the mesh before, interpolated; empty on the coarsest.
LevelResult solve_level(std::shared_ptr<const fem::Space> space, std::shared_ptr<const fem::Surface> surface,
                        const assembly::ShellDescription& shell, const contact::Settings& settings,
                        const std::optional<algebra::Vector>& touched, Seconds seconds, int number,
                        const Observer& observer) {
  const auto tell = [&](std::string_view phase) {
    if (observer.phase) observer.phase(number, phase);
  };
  Stopwatch watch;
  tell("geometry");
  auto discrete = assembly::discretise(space, surface, shell);
  seconds.discretisation = watch.lap();
  tell("assembly");
  const algebra::Matrix A = assembly::stiffness_matrix(discrete->shell, discrete->coordinates);
  seconds.assembly = watch.lap();
  tell("analysis");
  algebra::Factorisation F(A);
  seconds.analysis = watch.lap();
  tell("contact");
  const contact::BoxProblem box = assembly::box_problem(*discrete, A);
  const auto guess = touched ? first_guess(*discrete, *touched) : std::vector<contact::Activity>{};
  contact::BoxSolution z =
      contact::solve_primal_dual_active_set(box, guess, F, settings, [&](const contact::Iteration& i) {
        if (observer.iteration) observer.iteration(number, i);
      });
  if (held_inside_obstacle(*discrete)) z.status = contact::Status::infeasible;
  seconds.factorisation = F.seconds_numeric();
  seconds.iteration = watch.lap() - F.seconds_numeric();
  tell("certificate");
  assembly::NodalSolution nodal = assembly::nodal_solution(*discrete, z.z, z.activity);
  const assembly::Verdict verdict = assembly::certify(*discrete, nodal);
  seconds.certificate = watch.lap();

  Level record{.cells = space->global_cells,
               .nodes = space->layout->global_size,
               .unknowns = 5 * space->layout->global_size,
               .status = z.status,
               .active = verdict.summary.touching_nodes,
               .iterations = static_cast<int>(z.iterations.size()),
               .factorisations = F.factorisations(),
               .energy = verdict.summary.energy.total(),
               .reaction = verdict.summary.reaction.force.norm(),
               .min_gap = verdict.certificate.min_gap_nodes,
               .linear_residual = z.linear_residual,
               .history = z.iterations,
               .seconds = seconds};
  return {std::move(record), {std::move(discrete), std::move(nodal)}, verdict};
}

/// Whether the supports alone hold the shell: then the first step of the coarsest mesh went through with nothing in contact.
bool supports_hold(const Level& coarsest) { return !coarsest.history.empty() && coarsest.history.front().active == 0; }

bool nothing_to_refine(contact::Status status) {
  return status == contact::Status::infeasible || status == contact::Status::singular;
}

}  // namespace

Result solve(const Problem& problem, MPI_Comm comm, const Observer& observer) {
  const assembly::ShellDescription shell = describe(problem);
  Result result{.has_obstacle = problem.obstacle.has_value()};
  MPI_Comm_size(comm, &result.ranks);
  Stopwatch watch;
  fem::MeshSequence meshes(fem::coarse_mesh(problem.domain), problem.discretisation.degree, comm);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, problem.charts);

  std::optional<algebra::Vector> touched;
  for (int number = 0; number <= problem.discretisation.refinements; ++number) {
    if (number > 0) {
      std::array fields{std::move(result.solution->nodal.touching)};
      result.solution.reset();  // one mesh at a time in memory
      meshes.refine(fields);
      touched = std::move(fields[0]);
    }
    contact::Settings contact = problem.contact;
    if (number > 0 && supports_hold(result.levels.front())) contact.detect_free_motions = false;
    LevelResult level =
        solve_level(meshes.space(), surface, shell, contact, touched, {.mesh = watch.lap()}, number, observer);
    if (observer.level) observer.level(number, level.record);
    result.status = level.record.status;
    result.summary = level.verdict.summary;
    result.certificate = level.verdict.certificate;
    result.levels.push_back(std::move(level.record));
    result.solution = std::move(level.solution);
    if (nothing_to_refine(result.status)) break;
    watch.lap();
  }
  result.probes = probe(*result.solution, problem.probes);
  result.peak_memory = peak_memory(comm);
  return result;
}

}  // namespace plastron::study
