#include <plastron/solution/body_reactions.hpp>

#include <plastron/fem/constraints.hpp>

#include <algorithm>

namespace plastron::solution {

namespace {

using assembly::node_values;
using BodyVector = assembly::Vector6;

/// Returns (d, length theta).
BodyVector in_lengths(const fem::PlacedBody& placed, const fem::BodyMotion& motion) {
  BodyVector q;
  q << motion.displacement, placed.length * motion.rotation;
  return q;
}

/// Adds the unknowns whose nodes this rank owns. Returns their reactions, moments divided by the length; zero
/// elsewhere.
BodyVector add_unknowns(const assembly::DiscreteShell& discrete, const fem::PlacedBody& placed,
                        const algebra::Vector& residual, const algebra::Vector& load, BodyBalance& balance) {
  BodyVector reactions = BodyVector::Zero();
  for (int c = 0; c < 6; ++c) {
    const auto host = placed.hosts[c < 3 ? 0 : 1];
    if (host < 0 || host >= discrete.space().layout->owned) continue;
    const auto node = static_cast<std::size_t>(host);
    const double component = node_values(residual, node)[c % 3], given = node_values(load, node)[c % 3];
    const bool is_held = placed.body.fixed[static_cast<std::size_t>(c)].has_value();
    balance.all_forces += given * given + (is_held ? component * component : 0);
    if (is_held)
      reactions[c] = component;
    else
      balance.free_residual += component * component;
  }
  return reactions;
}

/// `reference`: the place of the reference point where the reactions act.
void add_reaction(const fem::PlacedBody& placed, const BodyVector& reactions, const BodyVector& motion,
                  const Vector3d& reference, BodyBalance& balance) {
  BodyReaction& body = balance.bodies.back();
  body.moment_at_reference = placed.length * reactions.tail<3>();
  const Vector3d force = reactions.head<3>(), lever = reference.cross(force);
  body.reaction = {force, body.moment_at_reference + lever};
  balance.reaction += body.reaction;
  balance.support_work += reactions.dot(motion);
  balance.force_scale += force.norm() + reactions.tail<3>().norm();
  balance.moment_scale += lever.norm() + body.moment_at_reference.norm();
}

double least_gap(const assembly::DiscreteShell& discrete, const fem::PlacedBody& placed, const algebra::Vector& y) {
  double least = std::numeric_limits<double>::infinity();
  for (const fem::BodyNode& member : placed.members) {
    if (member.node >= discrete.space().layout->owned) continue;
    const auto node = static_cast<std::size_t>(member.node);
    for (std::size_t k = 0; k < discrete.coordinates.gaps.size(); ++k) {
      const double gap = discrete.nodal_gap(k, node, y);
      if (!(gap >= least)) least = gap;  // true also for NaN
    }
  }
  return algebra::min_over_ranks(least, discrete.space().layout->comm);
}

}  // namespace

double distance_from_body(const assembly::DiscreteShell& discrete, std::size_t body, const algebra::Vector& y) {
  const fem::Space& space = discrete.space();
  const fem::PlacedBody& placed = space.bodies[body];
  const fem::BodyMotion motion = discrete.body_motion(body, y);
  const BodyVector q = in_lengths(placed, motion);
  double most = 0;
  for (const fem::BodyNode& member : placed.members) {
    if (member.node >= space.layout->owned) continue;
    const auto node = static_cast<std::size_t>(member.node);
    BodyVector rest = node_values(y, node) - discrete.carried(body, member, motion);
    if (!placed.body.turns_normals) rest.tail<3>().setZero();
    const double error = rest.head<3>().norm() + discrete.points[node].thickness * rest.tail<3>().norm();
    if (!(error <= most)) most = error;  // true also for NaN
  }
  for (Eigen::Index c = 0; c < 6; ++c) {
    const auto& value = placed.body.fixed[static_cast<std::size_t>(c)];
    const double unit = discrete.state.factors.support(placed.body.factor) * (c < 3 ? 1 : placed.length);
    if (value) most = std::max(most, std::abs(q[c] - unit * *value));
  }
  return most;
}

BodyBalance body_balance(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                         const algebra::Vector& residual) {
  BodyBalance balance;
  const fem::Space& space = *discrete.coordinates.space;
  if (space.bodies.empty()) return balance;
  algebra::Vector load = discrete.load;
  space.constraints.apply_transposed(load);
  for (std::size_t k = 0; k < space.bodies.size(); ++k) {
    const fem::PlacedBody& placed = space.bodies[k];
    const fem::BodyMotion motion = discrete.body_motion(k, y);
    balance.bodies.push_back({.name = placed.body.name,
                              .reference = placed.body.reference,
                              .displacement = motion.displacement,
                              .rotation = motion.rotation,
                              .least_gap = least_gap(discrete, placed, y)});
    BodyVector reactions = add_unknowns(discrete, placed, residual, load, balance);
    for (double& r : reactions) r = algebra::sum_over_ranks(r, space.layout->comm);
    add_reaction(placed, reactions, in_lengths(placed, motion), discrete.reference_of_body(k), balance);
    if (std::ranges::any_of(placed.body.fixed, [](const auto& value) { return value.has_value(); }))
      balance.support_error = std::max(balance.support_error, distance_from_body(discrete, k, y));
  }
  return balance;
}

}  // namespace plastron::solution
