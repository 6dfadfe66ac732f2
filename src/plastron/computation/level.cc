#include <plastron/computation/level.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/stiffness.hpp>
#include <plastron/computation/gap.hpp>
#include <plastron/computation/stopwatch.hpp>
#include <plastron/contact/solve.hpp>

namespace plastron::computation {

namespace {

/// Nodes of the new mesh that lie in the contact zone of the mesh before start in contact.
std::vector<contact::Activity> first_guess(const assembly::DiscreteShell& discrete, const algebra::Vector& touched) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  std::vector<contact::Activity> activity(coordinates.lower.owned().size(), contact::Activity::free);
  const auto block = static_cast<std::size_t>(touched.block());
  for (const assembly::ContactRow& row : coordinates.rows)
    if (row.binds && touched.owned()[row.node * block + static_cast<std::size_t>(row.obstacle)] > 0.5)
      activity[coordinates.at(row.node, row.coordinate)] =
          row.scale > 0 ? contact::Activity::at_lower : contact::Activity::at_upper;
  return activity;
}

/// A support holds the touching face inside of an obstacle: K is empty. No bound says so, for nothing can move there.
bool held_inside_obstacle(const assembly::DiscreteShell& discrete) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  std::int64_t held = 0;
  for (const assembly::ContactRow& row : coordinates.rows)
    if (is_held_inside(coordinates, discrete.points[row.node], row)) ++held;
  return algebra::sum_over_ranks(held, discrete.space().layout->comm) > 0;
}

Level record_of(const fem::Space& space, const contact::BoxSolution& z, const certificate::Verdict& verdict) {
  const int width = z.z.block() + (z.equation_multiplier.layout() ? 1 : 0);
  return {.cells = space.global_cells,
          .nodes = space.layout->global_size,
          .unknowns = width * space.layout->global_size,
          .status = z.status,
          .active = verdict.summary.touching_nodes,
          .iterations = static_cast<int>(z.iterations.size()),
          .energy = verdict.summary.energy.total(),
          .reaction = verdict.summary.reaction.force.norm(),
          .contact_area = verdict.summary.contact_area,
          .max_normal_rotation = verdict.summary.max_normal_rotation,
          .multiplier_norm = verdict.summary.multiplier_norm,
          .min_gap = verdict.certificate.min_gap_nodes,
          .linear_residual = z.linear_residual,
          .tolerances = z.tolerances,
          .max_rotation = verdict.summary.max_rotation,
          .history = z.iterations};
}

}  // namespace

LevelResult solve_level(const LevelTask& task, const assembly::ShellDescription& shell,
                        std::shared_ptr<const fem::Surface> surface, const Observer& observer) {
  const auto tell = [&](std::string_view phase) {
    if (observer.phase) observer.phase(task.number, phase);
  };
  Seconds seconds{.mesh = task.seconds_for_mesh};
  Stopwatch watch;
  tell("geometry");
  auto discrete = assembly::discretise(task.space, std::move(surface), shell);
  seconds.discretisation = watch.lap();
  tell("assembly");
  const algebra::Matrix A = assembly::stiffness_matrix(*discrete);
  seconds.assembly = watch.lap();
  tell("analysis");
  algebra::Factorisation F(A);
  seconds.analysis = watch.lap();
  tell("contact");
  const contact::BoxProblem box = assembly::box_problem(*discrete, A);
  const auto guess = task.touched ? first_guess(*discrete, *task.touched) : std::vector<contact::Activity>{};
  const contact::Observer follow{.iteration =
                                     [&](const contact::Iteration& i) {
                                       if (observer.iteration) observer.iteration(task.number, i);
                                     },
                                 .stop = [&] { return wants_to_stop(observer, task.space->layout->comm); }};
  contact::BoxSolution z = contact::solve(box, guess, F, task.settings, follow);
  if (held_inside_obstacle(*discrete)) z.status = contact::Status::infeasible;
  seconds.factorisation = F.seconds_numeric();
  seconds.iteration = watch.lap() - F.seconds_numeric();
  tell("certificate");
  certificate::NodalSolution nodal = certificate::nodal_solution(*discrete, z);
  const certificate::Verdict verdict = certificate::certify(*discrete, nodal);
  seconds.certificate = watch.lap();

  Level record = record_of(*task.space, z, verdict);
  record.factorisations = F.factorisations();
  record.seconds = seconds;
  return {std::move(record), {std::move(discrete), std::move(nodal)}, verdict};
}

}  // namespace plastron::computation
