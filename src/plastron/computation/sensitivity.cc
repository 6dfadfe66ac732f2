#include <plastron/computation/sensitivity.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/evaluation.hpp>
#include <plastron/computation/verify.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/finite/newton_step.hpp>
#include <plastron/meshing/imperfections.hpp>
#include <plastron/problem/instants.hpp>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace plastron::computation {

namespace {

using contact::Activity;

[[noreturn]] void refuse(const std::string& what) {
  throw SensitivityError("there are no derivatives with held contact " + what + "; use differences");
}

/// Returns the result if it has solutions of changed problems next to it.
const Result& checked(const problem::Problem& problem, const Result& result) {
  if (!result.solution || result.status != contact::Status::solved) refuse("of a result that is not solved");
  const assembly::DiscreteShell& discrete = *result.solution->discrete;
  if (problem.shell.tangency.formulation == element::Formulation::mixed) refuse("in the mixed formulation");
  if (!assembly::pressed_obstacles(discrete).empty()) refuse("where a force presses an obstacle");
  if (discrete.state.control) refuse("where the loads follow a displacement");
  if (discrete.obstacles.has_segments()) refuse("on a bed with a table");
  if (discrete.has_increments()) {
    if (discrete.obstacles.on_bed()) refuse("on a bed with finite rotations");
    return result;
  }
  if (discrete.state.is_deformed())
    refuse("for curved obstacles with small rotations, whose gaps are linearised at the solution");
  if (!result.solution->box.z.layout()) refuse("of a result that was loaded");
  return result;
}

std::unique_ptr<LinearAlgebra> tangent_of(const Solution& solution) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  return std::make_unique<LinearAlgebra>(finite::derivative_at(discrete, solution.nodal), std::vector<char>{},
                                         discrete.space().layout->comm);
}

/// The largest |u| or thickness times |r| at a node of any rank [m].
double length_of(const algebra::Vector& y, const std::vector<assembly::NodalPoint>& points) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const assembly::Vector6 at = assembly::node_values(y, i);
    largest = std::max({largest, at.head<3>().norm(), points[i].thickness * at.tail<3>().norm()});
  }
  return algebra::max_over_ranks(largest, y.layout()->comm);
}

/// The change from the coordinates of one shell to those of another, node by node: the same (u, r). The bases of free directions
/// may jump where two choices are alike.
class CoordinateChange {
 public:
  CoordinateChange(const assembly::DiscreteShell& from, const assembly::DiscreteShell& to)
      : width_(from.coordinates.width) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(from.space().layout->owned); ++i) {
      const assembly::NodeBasis &before = from.coordinates.basis[i], &after = to.coordinates.basis[i];
      const assembly::NodeBasis inverse = inverse_of(after);
      change_.push_back((inverse * before).topLeftCorner(width_, width_));
      for (int k = 0; k < width_; ++k)
        if (change_.back().row(k).isZero(0) || change_.back().col(k).isZero(0)) change_.back()(k, k) = 1;
      add_kept(inverse_of(before), inverse, from.points[i].thickness);
    }
  }
  void apply(algebra::Vector& z) const {
    for_nodes(z, [](const auto& change, auto&& values) { values = (change * values).eval(); });
  }
  void apply_transposed(algebra::Vector& f) const {
    for_nodes(f, [](const auto& change, auto&& values) { values = (change.transpose() * values).eval(); });
  }
  /// Whether an owned coordinate means nearly the same in both.
  bool keeps(std::size_t unknown) const { return kept_[unknown]; }

 private:
  static assembly::NodeBasis inverse_of(const assembly::NodeBasis& basis) {
    return basis.completeOrthogonalDecomposition().pseudoInverse();
  }
  /// Compares coordinates as functions of u and of thickness times r.
  void add_kept(assembly::NodeBasis before, assembly::NodeBasis after, double thickness) {
    constexpr double near = 0.1;
    before.rightCols<3>() /= thickness;
    after.rightCols<3>() /= thickness;
    for (int k = 0; k < width_; ++k)
      kept_.push_back((after.row(k) - before.row(k)).norm() <= near * before.row(k).norm());
  }
  template <class Change>
  void for_nodes(algebra::Vector& z, const Change& change) const {
    for (std::size_t i = 0; i < change_.size(); ++i)
      change(change_[i], Eigen::Map<Eigen::VectorXd>(z.at(i).data(), width_));
  }

  int width_;
  std::vector<Eigen::MatrixXd> change_{};
  std::vector<bool> kept_{};
};

/// Returns the change from the coordinates of the solution. Those that are held must mean the same.
CoordinateChange changed_coordinates(const assembly::DiscreteShell& solved, const contact::BoxSolution& z,
                                     const assembly::DiscreteShell& changed) {
  CoordinateChange change(solved, changed);
  bool is_kept = std::ranges::equal(solved.coordinates.rows, changed.coordinates.rows, {},
                                    &assembly::ContactRow::coordinate, &assembly::ContactRow::coordinate);
  for (std::size_t i = 0; i < z.activity.size(); ++i)
    is_kept = is_kept && (z.activity[i] == Activity::free || change.keeps(i));
  if (algebra::max_over_ranks(is_kept ? 0 : 1, changed.space().layout->comm) != 0)
    refuse("where the coordinates of the contact change");
  return change;
}

/// Returns the rest of the equilibrium at z in the free coordinates of the unchanged shell, and the ways of the others to their
/// bounds.
estimation::DualLoad rest_of(const contact::BoxProblem& box, const contact::BoxSolution& z,
                             const CoordinateChange& change) {
  algebra::Vector at = z.z, forces = box.load;
  at.update_ghosts();
  box.apply(at, forces);
  estimation::DualLoad rest{.load = box.load, .fixed = algebra::Vector(box.load.layout(), box.load.block())};
  algebra::axpy(-1, forces, rest.load);
  const auto keep_free = [&] {
    for (std::size_t i = 0; i < z.activity.size(); ++i)
      if (z.activity[i] != Activity::free) rest.load.owned()[i] = 0;
  };
  keep_free();
  change.apply_transposed(rest.load);
  keep_free();
  for (std::size_t i = 0; i < z.activity.size(); ++i) {
    if (z.activity[i] == Activity::free) continue;
    const algebra::Vector& bound = z.activity[i] == Activity::at_upper ? box.upper : box.lower;
    rest.fixed.owned()[i] = bound.owned()[i] - z.z.owned()[i];
  }
  return rest;
}

std::vector<Eigen::Vector2d> vertices_of(const problem::Problem& problem) {
  return domain::coarse_mesh(problem.domain, problem.discretisation.cells).vertices;
}

/// Kinks and rigid bodies belong to the space, which is that of the unchanged shell.
void check_space(const assembly::DiscreteShell& solved, const assembly::DiscreteShell& changed) {
  const fem::Space& space = solved.space();
  const bool moves = !std::ranges::equal(solved.points, changed.points,
                                         [](const auto& a, const auto& b) { return a.phi == b.phi && a.a3 == b.a3; });
  const auto constrained = static_cast<std::int64_t>(space.kinks.rows().size() + space.bodies.size());
  if (algebra::max_over_ranks(moves ? 1 : 0, space.layout->comm) != 0 &&
      algebra::sum_over_ranks(constrained, space.layout->comm) > 0)
    refuse("where the mid-surface changes and has kinks or rigid bodies");
}

}  // namespace

Sensitivity::Sensitivity(const problem::Problem& problem, const Result& result)
    : problem_(problem),
      result_(checked(problem, result)),
      solution_(*result.solution),
      algebra_(tangent_of(solution_)),
      at_solution_(finite::problem_at(*solution_.discrete, solution_.nodal, solution_.box, algebra_->A)),
      tangent_(at_solution_.box, at_solution_.z, algebra_->kept) {
  algebra_->kept.keep();
}

std::unique_ptr<assembly::DiscreteShell> Sensitivity::discretised(const problem::Problem& changed) const {
  if (vertices_of(problem_) != vertices_of(changed)) refuse("where the domain changes");
  if (problem_.rigid_bodies != changed.rigid_bodies) refuse("by numbers of rigid bodies");
  const energy::ShellOperator& shell = solution_.discrete->shell;
  auto coarse = std::make_shared<mesh::CoarseMesh>(shell.surface().coarse());
  coarse->shifts.clear();
  coarse->shifts = meshing::shifts_of(changed, *coarse);
  assembly::State state = solution_.discrete->state;
  state.factors = problem::instants(changed).back().factors;
  auto discrete = assembly::discretise(shell.space_pointer(),
                                       std::make_shared<const fem::Surface>(std::move(coarse), changed.charts),
                                       changed.shell, std::move(state));
  check_space(*solution_.discrete, *discrete);
  return discrete;
}

Solution Sensitivity::near(const problem::Problem& changed) const {
  constexpr int most_steps = 20;
  constexpr double tolerance = 1e-13, rounding = 1e-9, far = 0.1;  // parts of the solution's length
  const assembly::DiscreteShell& solved = *solution_.discrete;
  const double size = length_of(solution_.nodal.y, solved.points);
  Solution near{.discrete = discretised(changed), .nodal = {}};
  assembly::DiscreteShell& discrete = *near.discrete;
  contact::BoxSolution z = at_solution_.z;
  double last = INFINITY;
  for (int step = 0;; ++step) {
    const CoordinateChange change = changed_coordinates(solved, z, discrete);
    if (step == 0) change.apply(z.z);
    auto found = tangent_.solve(rest_of(finite::problem_at(discrete, solution_.nodal, z, algebra_->A).box, z, change));
    if (!found) refuse("where the linear equations cannot be solved");
    algebra::Vector& way = found->z;
    change.apply(way);
    way.update_ghosts();
    algebra::Vector motion(discrete.space().layout, 6);
    discrete.coordinates.to_cartesian(way, motion);
    const double length = length_of(motion, solved.points);
    if (!(length <= far * size) || step > most_steps)
      refuse("for so large a change of the case, or where the solution is nearly unstable");
    if (discrete.has_increments()) {
      assembly::State next = discrete.state;
      algebra::axpy(1, motion, next.displacement);
      next.displacement.update_ghosts();
      assembly::linearise(discrete, std::move(next));
    } else {
      algebra::axpy(1, way, z.z);
    }
    if (length <= tolerance * size || (length <= rounding * size && length > last / 2)) break;
    last = length;
  }
  z.z.update_ghosts();
  near.nodal = discrete.has_increments() ? solution::nodal_solution(discrete, solution_.nodal.touching)
                                         : solution::nodal_solution(discrete, z);
  return near;
}

Result Sensitivity::at(const problem::Problem& changed) const {
  Result result = measured_result(changed, near(changed));
  add_contact_zones(result);
  result.status = result_.status;
  return result;
}

}  // namespace plastron::computation
