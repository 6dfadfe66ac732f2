#include <plastron/assembly/box_problem.hpp>
#include <plastron/assembly/deformed.hpp>
#include <plastron/computation/bound_lifts.hpp>
#include <plastron/computation/relinearisation.hpp>
#include <plastron/computation/verify.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/finite/controlled_point.hpp>
#include <plastron/problem/instants.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace plastron::computation {

namespace {

using assembly::node_values;
using assembly::Vector6;
using certificate::CertificateLimit;

/// Limit as a part of the thickness or of the largest displacement, whichever is larger, as in the certificate for
/// supports.
constexpr double algebraic_part = 1e-6;
/// Limit of b(U, q) relative to the rotations. Where r . a_3 is not zero, b(U, q) is of their size; a solver leaves
/// 1e-12 of them.
constexpr double tangency_part = 1e-8;
/// Limit of a lift relative to the gap's decrease between nodes. Up to eight cells may meet at a node, and each
/// requires its own decrease (docs/methods/admissible.md).
constexpr double lift_per_dip = 10;

/// Returns (u, e r), a length.
Vector6 as_length(Vector6 y, double thickness) {
  y.tail<3>() *= thickness;
  return y;
}

double length_of(const Vector6& y) { return y.head<3>().norm() + y.tail<3>().norm(); }

/// Returns the distance of (u, e r) from the combinations of the node's coordinates.
double distance_from_span(const assembly::NodeBasis& basis, int width, const Vector6& y, double thickness) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> span = basis.leftCols(width);
  span.bottomRows<3>() *= thickness;
  const Vector6 given = as_length(y, thickness);
  return length_of(given - span * span.colPivHouseholderQr().solve(given));
}

/// Returns the distance of a kinked node from the position that its equation gives it [m].
double kink_error(const fem::Space& space, const algebra::Vector& y, std::size_t node, double thickness) {
  if (!space.kinks.constrains(node)) return 0;
  Vector6 rest = node_values(y, node);
  for (const constraints::Term& term : space.constraints.find(node)->terms)
    rest -= *term.block * node_values(y, static_cast<std::size_t>(term.node));
  return length_of(as_length(rest, thickness));
}

/// Returns the distance of a kinked node from the node that determines its displacement [m].
double kink_jump(const fem::Space& space, const algebra::Vector& y, std::size_t node) {
  const constraints::Row* row = space.kinks.find(node);
  if (!row) return 0;
  return (node_values(y, node) - node_values(y, static_cast<std::size_t>(row->terms.front().node))).head<3>().norm();
}

/// The largest distance of nodal values from the discrete space [m].
double space_error(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const fem::Space& space = discrete.space();
  algebra::Vector continuous = y;
  space.continuity.apply(continuous);
  const algebra::Vector kept =
      discrete.has_increments() ? with_kept_lengths(space, discrete.points, y) : algebra::Vector();
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(space.layout->owned); ++i) {
    const double e = discrete.points[i].thickness;
    const Vector6 here = node_values(y, i);
    double error = 0;
    if (space.continuity.constrains(i))
      error = length_of(as_length(here - node_values(continuous, i), e));
    else if (discrete.has_increments())
      error = length_of(as_length(here - node_values(kept, i), e)) + kink_jump(space, y, i);
    else if (!element::is_relaxed(discrete.tangency.formulation))
      // Also at kinks and bodies: bases span all of u, and r tangent to the shell.
      error = distance_from_span(coordinates.basis[i], 5, here, e);
    if (!(error <= most)) most = error;  // also for a NaN
    if (!discrete.has_increments()) most = std::max(most, kink_error(space, y, i, e));
  }
  for (std::size_t k = 0; k < space.bodies.size(); ++k) {
    const double error = solution::distance_from_body(discrete, k, y);
    if (!(error <= most)) most = error;
  }
  return algebra::max_over_ranks(most, discrete.space().layout->comm);
}

/// Returns the larger of two ratios (M14): max |b(U, q_i)| to the largest rotation, and the largest |lambda| where it
/// must be 0 to the largest anywhere.
double tangency_error(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                      double rotation) {
  algebra::Vector q(discrete.space().layout, 1);
  apply_coupling(discrete.shell, solution.y, q);
  const std::vector<char> zeros = multiplier_zeros(discrete.coordinates, *discrete.space().layout);
  double outside = 0;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    if (!zeros[i]) continue;
    q.owned()[i] = 0;
    if (!discrete.space().continuity.constrains(i)) outside = std::max(outside, std::abs(solution.lambda.owned()[i]));
  }
  const auto part = [](double some, double whole) { return whole > 0 ? some / whole : some; };
  outside = algebra::max_over_ranks(outside, discrete.space().layout->comm);
  return std::max(part(algebra::max_abs(q), rotation), part(outside, algebra::max_abs(solution.lambda)));
}

/// Returns max |u| of the displacement at which the gaps were linearised.
double moved(const assembly::DiscreteShell& discrete) {
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    most = std::max(most, discrete.state.at(i).head<3>().norm());
  return algebra::max_over_ranks(most, discrete.space().layout->comm);
}

/// Returns |R . d - F| / F, the largest over the obstacles that forces F d press.
double force_error(const assembly::DiscreteShell& discrete, const solution::Summary& summary,
                   const std::vector<std::size_t>& pressed) {
  double most = 0;
  for (const std::size_t k : pressed) {
    const Eigen::Vector3d given = discrete.state.factors.force(k) * discrete.obstacles.all[k].force;
    const double error = std::abs(summary.obstacles.at(k).reaction.force.dot(given) / given.squaredNorm() - 1);
    if (!(error <= most)) most = error;
  }
  return most;
}

/// Returns the largest distance of a solution from the state of its shell, rotations times the thickness [m].
double state_error(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const double error = length_of(as_length(discrete.in_coordinates(y, i), discrete.points[i].thickness));
    if (!(error <= most)) most = error;
  }
  return algebra::max_over_ranks(most, discrete.space().layout->comm);
}

void add_linearisation(const problem::Problem& problem, const assembly::DiscreteShell& discrete,
                       const solution::NodalSolution& solution, std::vector<CertificateLimit>& rows) {
  if (!has_rows_to_meet(discrete)) return;
  if (problem.shell.obstacles.are_linear) {
    rows.push_back({"linearisation_error", "m", moved(discrete), 0, false,
                    "the case wants the gaps linearised at the undeformed shell"});
    return;
  }
  const Nearness near = nearness(problem.linearisation, discrete, solution);
  if (discrete.obstacles.has_segments())
    rows.push_back({"closure_error", "m", near.closure, near.negligible, false,
                    "the bed gives by the closure that its table has at the pressure, to the tolerance of the case"});
  rows.push_back({"linearisation_error", "m", near.distance, near.negligible, false,
                  "faces in contact lie where their gaps are linearised, to the tolerance of the case"});
  rows.push_back({"depth_at_nodes", "m", near.depth, near.negligible, false,
                  "no face at a node is inside of a curved obstacle by its true distance, to the same tolerance"});
}

/// Adds rows on lifted bounds, which the solution defines itself. Lifts may only keep the shell out of obstacles
/// between its nodes.
void add_lifts(const assembly::DiscreteShell& discrete, const algebra::Vector& y, std::vector<CertificateLimit>& rows) {
  if (!discrete.state.is_admissible()) return;
  const auto lifts = discrete.state.lifts.owned();
  const double least = lifts.empty() ? 0 : *std::ranges::min_element(lifts);
  rows.push_back({"least_lift", "m", algebra::min_over_ranks(least, discrete.space().layout->comm), 0, true,
                  "bounds of gaps are lifted, never lowered"});
  rows.push_back({"largest_lift", "m", algebra::max_abs(discrete.state.lifts), lift_per_dip * largest_dip(discrete, y),
                  false,
                  "lifts make up for what gaps fall between nodes: a few times that, for they add up in rounds"});
}

}  // namespace

std::vector<CertificateLimit> membership_rows(const problem::Problem& problem, const assembly::DiscreteShell& discrete,
                                              const solution::NodalSolution& solution,
                                              const solution::Summary& summary) {
  const problem::Instant at_the_end = problem::instants(problem).back();
  const double length = std::max(summary.least_thickness, summary.max_displacement);
  std::vector<CertificateLimit> rows{
      {"load_error", "1",
       std::max({at_the_end.control ? 0 : std::abs(discrete.state.factors.loads - at_the_end.factors.loads),
                 std::abs(discrete.state.factors.supports - at_the_end.factors.supports),
                 std::abs(discrete.state.factors.time - at_the_end.factors.time)}),
       0, false, "the solution is one of the end of the loading that the case describes"},
      {"space_error", "m", space_error(discrete, solution.y), algebraic_part * length, false,
       "nodal values are combinations of the nodes' coordinates: r is tangent, joined edges move together, the edges "
       "of a rigid body as it does"}};
  if (discrete.state.control)
    rows.push_back({"control_error", "m", std::abs(finite::ControlledPoint(discrete).rest()), algebraic_part * length,
                    false, "the displacement that controls the loads has its value"});
  if (discrete.has_increments())
    rows.push_back({"state_error", "m", state_error(discrete, solution.y), algebraic_part * length, false,
                    "with finite rotations the solution is the state at which gaps, places and bounds are taken"});
  if (discrete.tangency.formulation == element::Formulation::mixed)
    rows.push_back(
        {"tangency_error", "1", tangency_error(discrete, solution, summary.max_rotation), tangency_part, false,
         "b(U, q) = 0 for all multipliers q, and lambda is one: to a part of the rotations that no result shows"});
  if (const auto pressed = pressed_obstacles(discrete); !pressed.empty())
    rows.push_back({"force_error", "1", force_error(discrete, summary, pressed), algebraic_part, false,
                    "the reaction to a pressed obstacle, along its force, is that force"});
  add_linearisation(problem, discrete, solution, rows);
  add_lifts(discrete, solution.y, rows);
  return rows;
}

}  // namespace plastron::computation
