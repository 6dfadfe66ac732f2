#include <plastron/estimation/dual_solver.hpp>

#include <plastron/contact/pressing.hpp>

#include <Eigen/LU>

#include <limits>

namespace plastron::estimation {

namespace {

constexpr double linear_tolerance = 1e-8;

contact::ActiveSet all_prescribed(contact::ActiveSet set) {
  for (contact::Activity& activity : set)
    if (activity != contact::Activity::free) activity = contact::Activity::prescribed;
  return set;
}

contact::BoxProblem without_bounds(const contact::BoxProblem& problem) {
  contact::BoxProblem dual{.matrix = problem.matrix,
                           .apply = problem.apply,
                           .load = algebra::Vector(problem.load.layout(), problem.load.block()),
                           .lower = problem.lower,
                           .upper = problem.upper,
                           .equations = problem.equations,
                           .shift = problem.shift};
  dual.lower.fill(-std::numeric_limits<double>::infinity());
  dual.upper.fill(std::numeric_limits<double>::infinity());
  return dual;
}

}  // namespace

DualSolver::DualSolver(const contact::BoxProblem& problem, const contact::BoxSolution& solution,
                       algebra::Preconditioner& preconditioner)
    : problem_(problem),
      set_(all_prescribed(solution.activity)),
      dual_(without_bounds(problem)),
      settings_{.linear_tolerance = linear_tolerance, .detect_free_motions = false},
      solver_(dual_, preconditioner, settings_) {
  for (const contact::PressingForce& force : problem.pressing)
    shapes_.push_back(contact::active_shape(force, solution.activity));
}

std::optional<DualSolution> DualSolver::solve_fixed(const algebra::Vector& load, const algebra::Vector& fixed) {
  dual_.load = load;
  for (std::size_t i = 0; i < set_.size(); ++i)
    if (set_[i] != contact::Activity::free) dual_.lower.owned()[i] = dual_.upper.owned()[i] = fixed.owned()[i];
  auto point =
      is_factorised_ ? solver_.refine(set_, algebra::Vector(load.layout(), load.block())) : solver_.solve_anew(set_);
  if (!point) return {};
  is_factorised_ = true;
  point->z.update_ghosts();
  return DualSolution{.z = std::move(point->z),
                      .multiplier = std::move(point->multiplier),
                      .positions = std::vector<double>(shapes_.size(), 0)};
}

DualSolution DualSolver::zero() const {
  const algebra::Vector none(problem_.load.layout(), problem_.load.block());
  return {.z = none, .multiplier = none, .positions = std::vector<double>(shapes_.size(), 0)};
}

bool DualSolver::find_responses() {
  const algebra::Vector no_load(problem_.load.layout(), problem_.load.block());
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    if (algebra::max_abs(shapes_[k]) == 0) continue;
    auto response = solve_fixed(no_load, shapes_[k]);
    if (!response) return false;
    responses_.push_back({k, std::move(*response)});
  }
  return true;
}

std::optional<DualSolution> DualSolver::solve(const DualLoad& dual) {
  if (responses_.empty() && !find_responses()) return {};
  auto found = solve_fixed(dual.load, dual.fixed);
  if (!found || responses_.empty()) return found;
  const auto count = static_cast<Eigen::Index>(responses_.size());
  Eigen::MatrixXd border(count, count);
  Eigen::VectorXd missing(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t force = responses_[static_cast<std::size_t>(k)].force;
    const double wanted = force < dual.positions.size() ? dual.positions[force] : 0;
    missing[k] = wanted - reaction(force, *found);
    for (Eigen::Index l = 0; l < count; ++l)
      border(k, l) = reaction(force, responses_[static_cast<std::size_t>(l)].to_motion);
  }
  const Eigen::VectorXd ways = border.fullPivLu().solve(missing);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Response& response = responses_[static_cast<std::size_t>(k)];
    algebra::axpy(ways[k], response.to_motion.z, found->z);
    algebra::axpy(ways[k], response.to_motion.multiplier, found->multiplier);
    found->positions[response.force] = ways[k];
  }
  found->z.update_ghosts();
  return found;
}

}  // namespace plastron::estimation
