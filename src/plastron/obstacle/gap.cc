#include <plastron/obstacle/gap.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace plastron::obstacle {

namespace {

/// Limit of the cosine between the obstacle's normal and the face's: below it an obstacle pushes the face inwards,
/// else sideways. 60 degrees.
constexpr double sideways = -0.5;

/// Half a fibre, from the mid-surface straight to the face; also used for other straight lines.
struct HalfFibre {
  /// `outward` is a unit vector.
  Vector3d middle, outward;
  double length;

  Vector3d at(double s) const { return middle + s * outward; }
  Vector3d face() const { return at(length); }
};

/// The first place on the line from + s direction, 0 < s <= length, where the distance changes its sign. No surface
/// is nearer than the distance, so steps of that length miss none. The least step, a hundredth of the line, may miss
/// a shorter chord.
std::optional<double> crossing(const Obstacle& obstacle, const Vector3d& from, const Vector3d& direction,
                               double length) {
  constexpr double least_step = 1e-2;
  const auto distance = [&](double s) { return obstacle.nearest(from + s * direction).distance; };
  const double first = distance(0);
  const auto is_beyond = [&](double d) { return (d < 0) != (first < 0); };
  double before = 0, d = first;
  while (before < length) {
    double after = std::min(before + std::max(std::abs(d), least_step * length), length);
    d = distance(after);
    if (is_beyond(d)) {
      while (after - before > 1e-15 * length) {
        const double middle = before + (after - before) / 2;
        (is_beyond(distance(middle)) ? after : before) = middle;
      }
      return after;
    }
    before = after;
  }
  return {};
}

FaceGap met_at(const Nearest& at) {
  return {.distance = at.distance, .normal = at.normal, .clearance = at.distance, .roundness = roundness(at)};
}

/// The gap to the tangent plane at `foot`, seen from the face; empty if the surface there does not face the
/// mid-surface.
std::optional<FaceGap> tangent_plane(const Obstacle& obstacle, const HalfFibre& fibre, double foot) {
  const Nearest at = obstacle.nearest(fibre.at(foot));
  if (!(at.normal.dot(fibre.outward) < 0)) return {};
  FaceGap gap = met_at(at);
  gap.distance = gap.clearance = at.normal.dot(fibre.outward) * (fibre.length - foot);
  return gap;
}

/// For a face inside the obstacle whose nearest way out is not its way in. The shell leaves along its fibre if the
/// fibre leaves the obstacle before the other face.
std::optional<FaceGap> out_along_fibre(const Obstacle& obstacle, const HalfFibre& fibre) {
  const auto way = crossing(obstacle, fibre.face(), -fibre.outward, 2 * fibre.length);
  return way ? tangent_plane(obstacle, fibre, fibre.length - *way) : std::nullopt;
}

/// Distance values of a convex obstacle near the line, at the point of the line nearest to the obstacle.
Nearest nearest_beside(const Obstacle& obstacle, const HalfFibre& fibre) {
  double before = 0, after = fibre.length;
  while (after - before > 1e-10 * fibre.length) {
    const double middle = (before + after) / 2;
    (obstacle.nearest(fibre.at(middle)).normal.dot(fibre.outward) < 0 ? before : after) = middle;
  }
  return obstacle.nearest(fibre.at(before));
}

/// For a face outside that looks away from the obstacle. The obstacle is in the half fibre, around the mid-surface,
/// or next to the fibre.
std::optional<FaceGap> behind_face(const Obstacle& obstacle, const HalfFibre& fibre, const Nearest& middle) {
  // The obstacle is also behind the mid-surface.
  if (!(middle.normal.dot(fibre.outward) < 0)) return {};
  if (middle.distance <= 0) {
    const auto way = crossing(obstacle, fibre.middle, -fibre.outward, fibre.length);
    return way ? tangent_plane(obstacle, fibre, -*way) : std::nullopt;
  }
  if (const auto way = crossing(obstacle, fibre.middle, fibre.outward, fibre.length))
    return tangent_plane(obstacle, fibre, *way);
  return met_at(nearest_beside(obstacle, fibre));
}

/// The entered face at a mid-surface point inside an obstacle that pushes it sideways. It is the face through which
/// the fibre does not leave.
double entered_face(const Obstacle& obstacle, const Vector3d& middle, const Vector3d& up, double half,
                    double otherwise) {
  const auto above = crossing(obstacle, middle, up, half), below = crossing(obstacle, middle, -up, half);
  if (!above && !below) return otherwise;
  return above && (!below || *above <= *below) ? -0.5 : 0.5;
}

// A smooth face on a sharp edge of an obstacle. The distance of a node does not describe this contact: its gradient jumps
// at the edge, and a node beside the edge may pass it. Instead the tangent plane of the face keeps the edge E on its other side,
//
//   g = n . (X - E),
//
// X the node's face. n is the normal of the face into the shell, or the nearest direction in the cone of the edge's normals.

/// Returns the nearest point of the obstacle if it lies on a sharp edge or a corner.
std::optional<Vector3d> foot_on_edge(const Obstacle& obstacle, const Vector3d& from) {
  constexpr double sharp = 1e-6;
  const Nearest nearest = obstacle.nearest(from);
  if (!(nearest.distance > 0) || !(roundness(nearest) <= sharp * nearest.distance)) return {};
  return from - nearest.distance * nearest.normal;
}

/// Returns an edge near the face, seen from above it. Seen from there, no side of the body is nearer than its edge.
std::optional<Vector3d> edge_below(const Obstacle& obstacle, const Vector3d& above, const Vector3d& inward,
                                   const Vector3d& a3, const Reach& reach) {
  constexpr double parallel = 1e-12;
  if (auto edge = foot_on_edge(obstacle, above)) return edge;
  // The tangent plane approaches the body most in this direction.
  const Vector3d normal = obstacle.nearest(above).normal, way = normal.dot(inward) * inward - normal;
  if (!(way.norm() > parallel)) return {};
  return foot_on_edge(obstacle, above + reach[reach_direction(a3, way)] * way.normalized());
}

/// With small rotations the force acts along the normal n_0 for the undeformed face, as loads act in undeformed places. The turn
/// of the tangent plane changes the gap by (n - n_0) . (X_0 - E), X_0 the face without its rotation.
std::optional<FaceGap> edge_gap(const Obstacle& obstacle, const ShellPoint& at, double z, const Reach& reach) {
  // More than one half, so that the nodes leave no edge out. Less than 1: an edge at the next node is left to it.
  constexpr double part_of_reach = 0.75;
  constexpr double small = 1e-3, least_cosine = 0.5;
  const double widest = *std::ranges::max_element(reach), side = z < 0 ? 1 : -1;
  const Vector3d inward = side * (at.a3 + at.r).normalized(), X = at.phi + at.u + z * (at.a3 + at.r);
  const Vector3d above = X + widest * inward;
  const Nearest seen = obstacle.nearest(above);
  // A face that lies on a side: at the side's edge the distance at X has the normal of either side.
  if ((seen.normal - inward).norm() < 1e-12)
    return FaceGap{.distance = seen.distance - widest, .normal = seen.normal, .clearance = seen.distance - widest};
  const auto edge = edge_below(obstacle, above, inward, at.a3, reach);
  if (!edge) return {};
  const Vector3d way = X - *edge, along = way.dot(inward) * inward - way;
  if (along.norm() > part_of_reach * reach[reach_direction(at.a3, along)]) return {};
  // Near the edge the distance has the normal that is the projection of the direction on the cone.
  const auto normal_for = [&](const Vector3d& direction) {
    return obstacle.nearest(*edge + small * widest * direction).normal;
  };
  const Vector3d n = normal_for(inward), n0 = at.is_turned ? n : normal_for(side * at.a3);
  if (!(n.dot(inward) > least_cosine)) return {};
  const double distance = n0.dot(way) + (n - n0).dot(way - z * at.r);
  return FaceGap{.distance = distance, .normal = n0, .clearance = distance, .roundness = 0};
}

/// The gap of the face at height z. `in_middle` contains the obstacle's nearest values at the mid-surface, if known.
FaceGap gap_of_face(const Obstacle& obstacle, const ShellPoint& at, double z, std::optional<Nearest> in_middle,
                    const Reach* reach) {
  const Vector3d middle = at.phi + at.u, director = at.a3 + at.r;
  const Nearest near = obstacle.nearest(middle + z * director);
  const HalfFibre fibre{middle, (z < 0 ? -1 : 1) * director.normalized(), std::abs(z) * director.norm()};
  FaceGap gap = met_at(near);
  const double away = near.normal.dot(fibre.outward);
  if (!obstacle.is_plane() && near.distance >= fibre.length && away > 0) gap.clearance -= fibre.length;
  if (!obstacle.is_plane() && near.distance < fibre.length) {
    if (!in_middle) in_middle = obstacle.nearest(middle);
    std::optional<FaceGap> other;
    if (near.distance < 0 && away > sideways)
      other = out_along_fibre(obstacle, fibre);
    else if (near.distance >= 0 && (away > 0 || in_middle->distance < near.distance))
      other = behind_face(obstacle, fibre, *in_middle);
    gap = other.value_or(gap);
  }
  if (reach && obstacle.has_edges() && std::abs(gap.distance) < *std::ranges::max_element(*reach)) {
    const auto edge = edge_gap(obstacle, at, z, *reach);
    constexpr double equal = 1e-9;  // on the edge itself rounding decides the normal of the distance
    if (edge && edge->distance < gap.distance + equal * fibre.length) gap = *edge;
  }
  gap.z = z;
  return gap;
}

FaceGap face_gap(const Obstacle& obstacle, const ShellPoint& at, const Reach* reach) {
  if (obstacle.face != Face::nearer)
    return gap_of_face(obstacle, at, (obstacle.face == Face::lower ? -0.5 : 0.5) * at.thickness, {}, reach);
  const Vector3d middle = at.phi + at.u, director = at.a3 + at.r;
  const Nearest in_middle = obstacle.nearest(middle);
  const Vector3d& facing = at.is_turned ? director : at.a3;
  double position = face_position(obstacle.face, in_middle.normal, facing);
  if (in_middle.distance < 0 && std::abs(in_middle.normal.dot(facing)) < -sideways)
    position = entered_face(obstacle, middle, director.normalized(), director.norm() * at.thickness / 2, position);
  return gap_of_face(obstacle, at, position * at.thickness, in_middle, reach);
}

Gap linearised(const FaceGap& gap, const ShellPoint& at) {
  return {gap.distance - gap.normal.dot(at.u + gap.z * at.r), gap.normal, gap.z, at.phi + gap.z * at.a3};
}

double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at, const Reach* reach) {
  if (gap.arm == 0) return obstacle.nearest(gap.contact_point + at.u).distance;
  return gap_of_face(obstacle, at, gap.z, {}, reach).distance;
}

}  // namespace

std::size_t reach_direction(const Vector3d& a3, const Vector3d& way) {
  const Vector3d first = a3.unitOrthogonal();
  const double turns = std::atan2(way.dot(a3.cross(first)), way.dot(first)) / (2 * std::numbers::pi);
  return static_cast<std::size_t>(std::lround((turns + 1) * 8)) % 8;
}

void prepare_gaps(const Obstacle& obstacle, std::span<const ShellPoint> points) {
  if (!obstacle.is_searched()) return;
  std::vector<Vector3d> places;
  for (const ShellPoint& at : points) places.push_back(at.phi + at.u);
  obstacle.prepare(places);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ShellPoint& at = points[i];
    const Vector3d director = at.a3 + at.r;
    const Vector3d normal = obstacle.face == Face::nearer ? obstacle.nearest(places[i]).normal : Vector3d::Zero();
    places[i] += face_position(obstacle.face, normal, at.is_turned ? director : at.a3) * at.thickness * director;
  }
  obstacle.prepare(places);
}

FaceGap face_gap(const Obstacle& obstacle, const ShellPoint& at) { return face_gap(obstacle, at, nullptr); }

Gap gap_at(const Obstacle& obstacle, const ShellPoint& at) { return linearised(face_gap(obstacle, at), at); }

Gap gap_at(const Obstacle& obstacle, const ShellPoint& at, const Reach& reach) {
  return linearised(face_gap(obstacle, at, &reach), at);
}

double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at) {
  return true_gap(obstacle, gap, at, nullptr);
}

double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at, const Reach& reach) {
  return true_gap(obstacle, gap, at, &reach);
}

}  // namespace plastron::obstacle
