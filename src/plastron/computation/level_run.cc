#include <plastron/computation/level_run.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/contact_forecast.hpp>
#include <plastron/computation/resources.hpp>
#include <plastron/contact/solve.hpp>

namespace plastron::computation {

contact::BoxSolution LevelRun::solve(const algebra::Vector* zone, bool detect_free_motions) {
  Stopwatch watch;
  tell("assembly");
  last_.reset();
  algebra::Matrix A = assembly::stiffness_matrix(*discrete_);
  seconds.assembly += watch.lap();
  tell("analysis");
  contact::Settings settings = task_.settings;
  settings.detect_free_motions = settings.detect_free_motions && detect_free_motions;
  const bool knows_zone = zone && !settings.detect_free_motions;
  last_ = std::make_unique<LinearAlgebra>(std::move(A),
                                          knows_zone ? open_coordinates(*discrete_, *zone) : std::vector<char>{},
                                          discrete_->space().layout->comm);
  const algebra::Factorisation& F = last_->F;
  seconds.analysis += watch.lap();
  tell("contact");
  const contact::BoxProblem& box = last_->box.emplace(assembly::box_problem(*discrete_, last_->A));
  const auto guess = zone ? assembly::likely_activity(discrete_->coordinates, *zone) : std::vector<contact::Activity>{};
  contact::BoxSolution z = contact::solve(box, guess, last_->kept, settings, follow());
  if (!z.positions.empty()) press(*discrete_, z.positions);
  if (held_inside_obstacle(*discrete_)) z.status = contact::Status::infeasible;
  seconds.factorisation += F.seconds_numeric();
  seconds.iteration += watch.lap() - F.seconds_numeric();
  factorisations += F.factorisations();
  history.insert(history.end(), z.iterations.begin(), z.iterations.end());
  return z;
}

contact::BoxSolution LevelRun::prepare_duals(const contact::BoxSolution& z, const solution::NodalSolution& nodal) {
  if (!discrete_->has_increments()) return z;
  Stopwatch watch;
  last_ = std::make_unique<LinearAlgebra>(finite::derivative_at(*discrete_, nodal), std::vector<char>{},
                                          discrete_->space().layout->comm);
  finite::ProblemAtSolution at = finite::problem_at(*discrete_, nodal, z, last_->A);
  last_->box.emplace(std::move(at.box));
  seconds.estimates += watch.lap();
  return std::move(at.z);
}

std::vector<double> LevelRun::values(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                     const solution::Summary& summary) const {
  return estimation::values(task_.valued, solved(z, nodal, summary));
}

finite::NewtonStep LevelRun::newton_step(const finite::StepStart& start) {
  Stopwatch watch;
  tell("contact");
  contact::Settings settings = task_.settings;
  settings.solver = nullptr;  // others need a definite matrix
  finite::NewtonStep step = finite::newton_step(*discrete_, start, settings, follow());
  seconds.iteration += watch.lap();
  factorisations += step.factorisations;
  ++linearisations;
  history.insert(history.end(), step.box.iterations.begin(), step.box.iterations.end());
  return step;
}

estimation::Estimates LevelRun::estimate(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                         const solution::Summary& summary) {
  Stopwatch watch;
  tell("estimates");
  last_->kept.keep();
  auto estimates = estimation::estimate(solved(z, nodal, summary), last_->kept, *task_.goals);
  for (std::size_t g = 0; g < estimates.goals.size(); ++g)
    estimates.goals[g].scale = estimation::relative_scale((*task_.goals)[g], estimates.goals[g], summary);
  seconds.estimates += watch.lap();
  return estimates;
}

std::optional<double> LevelRun::buckling(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                         const solution::Summary& summary) {
  Stopwatch watch;
  last_->kept.keep();
  const auto found = estimation::buckling(solved(z, nodal, summary), last_->kept);
  seconds.estimates += watch.lap();
  return found;
}

void LevelRun::tell(std::string_view phase) const {
  if (observer_.phase) observer_.phase(task_.number, phase);
}

estimation::Solved LevelRun::solved(const contact::BoxSolution& z, const solution::NodalSolution& nodal,
                                    const solution::Summary& summary) const {
  return {.discrete = *discrete_,
          .nodal = nodal,
          .box = *last_->box,
          .z = z,
          .singular = recovery::singular_places(*discrete_, nodal, summary)};
}

contact::Observer LevelRun::follow() const {
  return {.iteration =
              [this](const contact::Iteration& i) {
                if (observer_.iteration) observer_.iteration(task_.number, i);
              },
          .stop = [this] { return wants_to_stop(observer_, discrete_->space().layout->comm); }};
}

bool held_inside_obstacle(const assembly::DiscreteShell& discrete) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  std::int64_t fixed = 0;
  for (const assembly::ContactRow& row : coordinates.rows)
    if (coordinates.is_fixed_inside(row, discrete.points[row.node])) ++fixed;
  return algebra::sum_over_ranks(fixed, discrete.space().layout->comm) > 0;
}

}  // namespace plastron::computation
