#include <plastron/fem/kept_angles.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/fem/kinks.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/geometry/rotation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace plastron::fem {

using algebra::LocalIndex;
using Eigen::Vector3d;

namespace {

/// Sine of the angle between directors below which they count as parallel: their cross product then says little about the axis.
constexpr double parallel_directors = 1e-3;

double sine_between(const Vector3d& a, const Vector3d& b) { return a.normalized().cross(b.normalized()).norm(); }

/// A node at a kink that follows the node that decides u.
struct Follower {
  std::size_t node;
  /// Other nodes in its row, without those that change its r little; one or two, none if all its kinks are hinges.
  std::vector<std::size_t> turns_with;
  Vector3d along;  ///< axis about which it turns with another; zero where it has no rotation of its own
};

/// Whether the rotation of a node at a kink depends on the node that decides its u. Hinges separate the others.
bool turns_with_deciding(const constraints::Row& row) {
  return !row.terms.front().block->bottomRightCorner<3, 3>().isZero(0);
}

/// Reads a follower from its row in the undeformed space. The first node of the row decides u.
Follower follower_of(const constraints::Row& row, const Vector3d& normal) {
  constexpr double little = 0.05;
  Follower follower{.node = static_cast<std::size_t>(row.node), .turns_with = {}, .along = Vector3d::Zero()};
  const Vector3d a3 = normal.normalized();
  const Eigen::Matrix3d own = row.own().bottomRightCorner<3, 3>() - a3 * a3.transpose();
  Eigen::Index largest = 0;
  if (own.colwise().norm().maxCoeff(&largest) > little) follower.along = own.col(largest).normalized();
  const std::size_t most = follower.along.isZero(0) ? 2 : 1;
  const auto decides = static_cast<std::size_t>(row.terms.front().node);
  for (const constraints::Term& term : row.terms) {
    const auto other = static_cast<std::size_t>(term.node);
    if (other != decides && other != follower.node && follower.turns_with.size() < most &&
        term.block->bottomRightCorner<3, 3>().norm() > little)
      follower.turns_with.push_back(other);
  }
  if (follower.turns_with.size() < most && turns_with_deciding(row)) follower.turns_with.push_back(decides);
  return follower;
}

constexpr double nearly_parallel = 0.05;

bool contains(const std::vector<std::size_t>& nodes, std::size_t node) {
  return std::ranges::find(nodes, node) != nodes.end();
}

/// Returns the node with which a follower keeps its angle: `other`, or the node most at right angles that turns with `other` about
/// the same axis if the directors are nearly parallel, as in the two halves of a plate with a rib. A follower without a rotation
/// of its own turns about two axes: the axis with its second node is not this one.
std::size_t keeps_angle_with(std::size_t other, const Follower& follower, const std::vector<Follower>& group,
                             std::span<const Vector3d> normals) {
  const auto apart = [&](std::size_t a, std::size_t b) {
    return sine_between(normals[a], normals[b]) >= nearly_parallel;
  };
  const auto has_same_axis = [&](std::size_t node) {
    if (follower.along.isZero(0))
      return std::ranges::all_of(follower.turns_with,
                                 [&](std::size_t next) { return next == other || apart(node, next); });
    return sine_between(normals[other].cross(normals[node]), follower.along) < nearly_parallel;
  };
  if (apart(other, follower.node)) return other;
  std::size_t best = other;
  const auto sine = [&](std::size_t node) { return sine_between(normals[node], normals[follower.node]); };
  for (const Follower& next : group)
    for (const auto& [node, turns] : {std::pair{next.node, contains(next.turns_with, other)},
                                      std::pair{next.turns_with.back(), next.node == other}})
      if (turns && node != follower.node && apart(other, node) && has_same_axis(node) && sine(node) > sine(best))
        best = node;
  return best;
}

/// A pair of local nodes whose directors keep their angle. The axis of parallel directors is not their cross product: it turns from
/// `along` by the least rotation of the first director.
struct KeptAngle {
  std::size_t other, node;
  Vector3d along;
};

/// Adds the pairs of a follower.
void add_pairs(const Follower& follower, const std::vector<Follower>& group, std::span<const Vector3d> normals,
               std::vector<KeptAngle>& pairs) {
  const Vector3d& normal = normals[follower.node];
  for (const std::size_t turns_with : follower.turns_with) {
    const std::size_t other = keeps_angle_with(turns_with, follower, group, normals);
    if (!follower.along.isZero(0) || sine_between(normal, normals[other]) >= nearly_parallel) {
      pairs.push_back({other, follower.node, follower.along});
      continue;
    }
    // A node without a rotation of its own has all of it from a node with a parallel director.
    const Vector3d first = normal.unitOrthogonal();
    pairs.push_back({other, follower.node, first});
    pairs.push_back({other, follower.node, normal.normalized().cross(first)});
    return;
  }
}

/// Returns the pairs of nodes that keep their angle, by the rows of the undeformed space. A rank sees all nodes of a kink or none.
std::vector<KeptAngle> kept_angles(const Space& space, std::span<const Vector3d> normals) {
  std::map<LocalIndex, std::vector<Follower>> groups;
  for (const constraints::Row& kink : space.kinks.rows()) {
    const auto node = static_cast<std::size_t>(kink.node);
    if (space.continuity.constrains(node)) continue;
    Follower follower = follower_of(*space.constraints.find(node), normals[node]);
    if (!follower.turns_with.empty()) groups[kink.terms.front().node].push_back(std::move(follower));
  }
  std::vector<KeptAngle> pairs;
  for (auto& [decides, group] : groups) {
    // The order must be the same on all ranks: of equal angles the first counts.
    std::ranges::sort(group, {},
                      [&](const Follower& f) { return space.layout->global(static_cast<LocalIndex>(f.node)); });
    for (const Follower& follower : group) add_pairs(follower, group, normals, pairs);
  }
  return pairs;
}

using Pair = std::array<Vector3d, 2>;  ///< two unit vectors

Pair unit_vectors(std::span<const Vector3d> vectors, std::size_t first, std::size_t second) {
  return {vectors[first].normalized(), vectors[second].normalized()};
}

bool are_parallel(const Pair& pair) { return pair[0].cross(pair[1]).norm() <= parallel_directors; }

/// Returns the axis of a pair after the directors have turned from `normals`.
Vector3d turned_axis(const KeptAngle& pair, std::span<const Vector3d> normals, std::span<const Vector3d> directors) {
  const Pair before = unit_vectors(normals, pair.other, pair.node),
             now = unit_vectors(directors, pair.other, pair.node);
  if (!are_parallel(before)) return now[0].cross(now[1]).normalized();
  const Vector3d axis = Eigen::Quaterniond::FromTwoVectors(before[0], now[0]) * pair.along;
  return geometry::tangential(axis, now[0]).normalized();
}

/// Expresses the nodes of pairs for small motions from a state with these directors.
ExpressedKinks expressed_at(const Space& space, const std::vector<KeptAngle>& pairs, std::span<const Vector3d> normals,
                            std::span<const Vector3d> directors) {
  std::vector<Kink> kinks;
  std::set<std::size_t> following;
  const auto node_at = [&](std::size_t node, const Vector3d& axis) {
    return BoundaryNode{space.layout->global(static_cast<LocalIndex>(node)), Vector3d::Zero(), directors[node], axis};
  };
  for (const KeptAngle& pair : pairs) {
    const Vector3d axis = turned_axis(pair, normals, directors);
    following.insert(pair.node);
    kinks.push_back({{node_at(pair.other, axis), node_at(pair.node, axis)}});
  }
  for (const constraints::Row& kink : space.kinks.rows()) {
    const auto node = static_cast<std::size_t>(kink.node), decides = static_cast<std::size_t>(kink.terms.front().node);
    // A node that keeps an angle has its u by that pair. A hinge beside it would let the order of nodes, which ranks choose
    // differently, decide which of both keeps the angle.
    if (space.continuity.constrains(node) || following.contains(node)) continue;
    if (!turns_with_deciding(*space.constraints.find(node)))
      kinks.push_back({{node_at(decides, Vector3d::Zero()), node_at(node, Vector3d::Zero())}, true});
  }
  return expressed(kinks);
}

/// Returns the second director of a pair, turned in the plane of both so that they have the angle of the reference. Parallel
/// directors have no such plane: the second turns about the axis of the pair.
Vector3d at_kept_angle(const Vector3d& along, const Vector3d& axis, const Pair& before, const Pair& now) {
  const double cosine = before[0].dot(before[1]), sine = before[0].cross(before[1]).norm();
  if (!are_parallel(before)) return cosine * now[0] + sine * (now[1] - now[0].dot(now[1]) * now[0]).normalized();
  const double angle = std::atan2(along.dot(before[0].cross(before[1])), cosine), tilt = axis.dot(now[1]);
  const Vector3d level = geometry::rotation_of(angle * axis) * (now[0] - axis.dot(now[0]) * axis).normalized();
  return tilt * axis + std::sqrt(std::max(0.0, 1 - tilt * tilt)) * level;
}

/// Returns the unit vector nearest to `now` that has two cosines with two unit vectors.
Vector3d with_cosines(const Pair& others, const std::array<double, 2>& cosines, const Vector3d& now) {
  const double between = others[0].dot(others[1]), determinant = 1 - between * between;
  const Vector3d level =
      ((cosines[0] - between * cosines[1]) * others[0] + (cosines[1] - between * cosines[0]) * others[1]) / determinant;
  const Vector3d normal = others[0].cross(others[1]).normalized();
  return level + std::copysign(std::sqrt(std::max(0.0, 1 - level.squaredNorm())), normal.dot(now)) * normal;
}

/// Returns the director of a node that keeps its angles with two others, or that has all its rotation from one parallel director.
/// Pairs: an other director and that of the node.
Vector3d from_two_others(const Pair& before, const Pair& now, const Pair& second_before, const Pair& second_now) {
  const Pair others_before{before[0], second_before[0]}, others{now[0], second_now[0]};
  if (are_parallel(others_before)) return Eigen::Quaterniond::FromTwoVectors(before[0], now[0]) * before[1];
  return with_cosines(others, {before[0].dot(before[1]), second_before[0].dot(second_before[1])}, now[1]);
}

}  // namespace

std::vector<constraints::Row> turned_kinks(const Space& space, std::span<const Vector3d> normals,
                                           std::span<const Vector3d> directors) {
  std::vector<constraints::Row> rows;
  for (const auto& [node, kinked] : expressed_at(space, kept_angles(space, normals), normals, directors).nodes)
    rows.push_back(row_of(*space.layout, space.layout->local(node), kinked));
  return rows;
}

void keep_angles(const Space& space, std::span<const Vector3d> normals, std::span<Vector3d> directors) {
  const std::vector<KeptAngle> pairs = kept_angles(space, normals);
  const std::vector<Kink> sequence = expressed_at(space, pairs, normals, normals).sequence;
  const auto local = [&](const BoundaryNode& node) { return static_cast<std::size_t>(space.layout->local(node.node)); };
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    const std::size_t other = local(sequence[i].nodes[0]), node = local(sequence[i].nodes[1]);
    const Pair before = unit_vectors(normals, other, node), now = unit_vectors(directors, other, node);
    Vector3d director;
    if (i + 1 < sequence.size() && sequence[i + 1].nodes[1].node == sequence[i].nodes[1].node) {
      const std::size_t second = local(sequence[++i].nodes[0]);
      director =
          from_two_others(before, now, unit_vectors(normals, second, node), unit_vectors(directors, second, node));
    } else {
      const auto pair = std::ranges::find_if(pairs, [&](const KeptAngle& p) {
        return std::set{p.other, p.node} == std::set{other, node};
      });
      PLASTRON_ASSERT(pair != pairs.end(), other, node);
      director = at_kept_angle(pair->along, turned_axis(*pair, normals, directors), before, now);
    }
    directors[node] = normals[node].norm() * director;
  }
}

}  // namespace plastron::fem
