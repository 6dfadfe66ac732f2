// Proximal points: they continue from a set that leaves a motion free, though more active bounds would fix it. From a
// centre z_k in the box
//   z_{k+1} = the minimiser of  J(z) + rho/2 (z - z_k)' D (z - z_k)  over the box,   D = diag A,
// It is a strictly convex program, which active sets solve with A + rho D in place of A. Then the ordinary method is
// tried from the set of z_{k+1}. If it meets a free motion again, rho decreases and z_{k+1} is the next centre.
// docs/methods/contact.md shows why the sets become the set of a solution, if there is one. Source: Rockafellar,
// Monotone operators and the proximal point algorithm (1976).
#include <plastron/contact/active_set_steps.hpp>
#include <plastron/contact/searches.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plastron::contact {
namespace {

using algebra::Vector;

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Returns D z.
Vector weighed_by(const Vector& diagonal, Vector z) {
  for (std::size_t i = 0; i < z.owned().size(); ++i) z.owned()[i] *= diagonal.owned()[i];
  return z;
}

/// Adds rho D z to y.
void add_weighed(double rho, const Vector& diagonal, const Vector& z, Vector& y) {
  for (std::size_t i = 0; i < z.owned().size(); ++i) y.owned()[i] += rho * (z.owned()[i] * diagonal.owned()[i]);
}

double energy_of(const BoxProblem& problem, const Vector& z) {
  Vector Az(problem.load.layout(), problem.load.block());
  problem.apply(z, Az);
  return 0.5 * algebra::dot(z, Az) - algebra::dot(z, problem.load);
}

class ProximalPoints {
 public:
  ProximalPoints(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                 const Observer& observer, SolverFunction& shifted_solver, BoxSolution& solution)
      : problem_(problem),
        subproblems_(subproblems),
        settings_(settings),
        observer_(observer),
        shifted_solver_(shifted_solver),
        solution_(solution),
        centre_(project(problem, Vector(problem.load.layout(), problem.load.block()))),
        guess_(solution.activity) {
    Vector z = project(problem, solution.z);
    if (energy_of(problem, z) < energy_of(problem, centre_)) centre_ = std::move(z);
    if (count_active(problem, guess_) == 0) guess_ = everything_at_bounds(problem, centre_);
  }

  Status run() {
    constexpr double first_rho = 1e-5, last_rho = 1e-9, step = 0.1;
    for (double rho = first_rho; rho > 0.5 * last_rho; rho *= step) {
      const BoxSolution next = proximal_point(rho);
      if (next.status != Status::solved) return next.status;
      if (is_driven_away(next)) return unheld();
      if (const auto end = ordinary_method(next.activity)) return *end;
      centre_ = further(project(problem_, next.z));
      guess_ = next.activity;
    }
    return unheld();
  }

 private:
  int iterations() const { return static_cast<int>(solution_.iterations.size()); }

  /// Computes z_{k+1}. Its energies are J(z) + rho/2 (z - z_k)' D (z - z_k).
  BoxSolution proximal_point(double rho) {
    const Vector& D = subproblems_.diagonal();
    const Vector pull = weighed_by(D, centre_);
    const double offset = 0.5 * rho * algebra::dot(centre_, pull);
    BoxProblem shifted{.matrix = problem_.matrix,
                       .apply =
                           [&, rho](const Vector& z, Vector& y) {
                             problem_.apply(z, y);
                             add_weighed(rho, D, z, y);
                           },
                       .load = problem_.load,
                       .lower = problem_.lower,
                       .upper = problem_.upper,
                       .shift = rho};
    algebra::axpy(rho, pull, shifted.load);
    Settings settings = settings_;
    settings.max_iterations = settings_.max_iterations - iterations();
    settings.detect_free_motions = false;
    const Observer follow{.iteration = [&](const Iteration& i) { keep(i, offset); }, .stop = observer_.stop};
    if (settings.max_iterations <= 0) return unsolved(problem_, Status::iteration_limit);
    return shifted_solver_(shifted, guess_, subproblems_.preconditioner(), settings, follow);
  }

  void keep(Iteration iteration, double offset) {
    iteration.energy += offset;
    iteration.safeguarded = true;
    solution_.iterations.push_back(iteration);
    if (observer_.iteration) observer_.iteration(iteration);
  }

  /// Runs the ordinary method from a set. Returns nothing if it meets a free motion or makes no progress.
  std::optional<Status> ordinary_method(ActiveSet set) {
    if (iterations() >= settings_.max_iterations) return Status::iteration_limit;
    PressedSubproblem subproblems(problem_, subproblems_.preconditioner(), settings_);
    auto point = subproblems.solve(set);
    const Observer follow{.iteration =
                              [&](const Iteration&) {
                                solution_.iterations.back().safeguarded = true;
                                if (observer_.iteration) observer_.iteration(solution_.iterations.back());
                              },
                          .stop = observer_.stop};
    const StepsEnd end =
        iterate_active_sets(problem_, subproblems, std::move(point), settings_, follow, set, solution_);
    if (end == StepsEnd::ended) return solution_.status;
    if (end == StepsEnd::no_minimiser && subproblems.failure() != Status::singular) return subproblems.failure();
    return {};
  }

  /// Continues along the line from the centre to z, while the energy decreases and at most to the next bound.
  Vector further(Vector z) const {
    Vector back = centre_, gradient(z.layout(), z.block()), force = gradient;
    algebra::axpy(-1, z, back);
    back.update_ghosts();
    problem_.apply(z, gradient);
    algebra::axpy(-1, problem_.load, gradient);
    problem_.apply(back, force);
    const double slope = algebra::dot(gradient, back), curvature = algebra::dot(back, force);
    const double step = std::min(curvature > 0 ? slope / curvature : no_limit,
                                 largest_feasible_step(problem_.lower, problem_.upper, z, back));
    if (!(step > 0) || std::isinf(step)) return z;
    return clamped_step(problem_.lower, problem_.upper, z, back, step);
  }

  /// Whether the energy seems to have no lower bound. Then steps grow like 1/rho along a motion without stiffness that
  /// does work, with no bound ahead.
  bool is_driven_away(const BoxSolution& next) {
    constexpr double like_one_over_rho = 5;
    constexpr int convinced = 2;
    Vector way = next.z;
    algebra::axpy(-1, centre_, way);
    const double length = std::sqrt(algebra::dot(way, weighed_by(subproblems_.diagonal(), way)));
    growths_ = length > like_one_over_rho * last_length_ && last_length_ > 0 ? growths_ + 1 : 0;
    last_length_ = length;
    return growths_ >= convinced && !has_bound_ahead(way, length);
  }

  bool has_bound_ahead(const Vector& way, double length) const {
    constexpr double noticeable = 1e-6;
    std::int64_t ahead = 0;
    for (std::size_t i = 0; i < way.owned().size(); ++i) {
      const double s = way.owned()[i];
      const double bound = s > 0 ? problem_.upper.owned()[i] : problem_.lower.owned()[i];
      const double size = std::abs(s) * std::sqrt(std::max(subproblems_.diagonal().owned()[i], 0.0));
      ahead += size > noticeable * length && std::isfinite(bound);
    }
    return algebra::sum_over_ranks(ahead, way.layout()->comm) > 0;
  }

  Status unheld() {
    if (subproblems_.solve(everything_active(problem_))) return Status::not_held;
    return subproblems_.failure();
  }

  const BoxProblem& problem_;
  SubproblemSolver& subproblems_;
  const Settings& settings_;
  const Observer& observer_;
  SolverFunction& shifted_solver_;
  BoxSolution& solution_;
  Vector centre_;
  ActiveSet guess_;
  double last_length_ = 0;
  int growths_ = 0;
};

}  // namespace

void continue_proximal_points(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                              const Observer& observer, SolverFunction& shifted_solver, BoxSolution& so_far) {
  so_far.status = ProximalPoints(problem, subproblems, settings, observer, shifted_solver, so_far).run();
}

}  // namespace plastron::contact
