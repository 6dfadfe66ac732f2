#include <plastron/computation/passage.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/obstacle/error.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace plastron::computation {

namespace {

using Eigen::Vector3d;

/// Part of the thickness that any obstacle may move in one step.
constexpr double short_way = 0.25;

/// An obstacle before and after its motion, and the displacement of its points.
struct Moving {
  obstacle::Obstacle before, after;

  Vector3d way(const Vector3d& X) const { return after.placement.to_space(before.placement.to_body(X)) - X; }
};

/// `X`: place of the node's mid-surface now, `a3`: the shell's direction there.
bool may_pass_at(const Moving& moving, const assembly::NodalPoint& point, const Vector3d& X, const Vector3d& a3) {
  // Size of the region around the node: an obstacle may be smaller than the distance of nodes.
  const double around = 2 * std::sqrt(point.weight) + point.thickness / 2, way = moving.way(X).norm();
  if (way <= short_way * point.thickness) return false;
  const obstacle::Nearest first = moving.before.nearest(X);
  if (first.distance - way > around) return false;
  const obstacle::Nearest last = moving.after.nearest(X);
  return (first.distance + last.distance - way) / 2 <= around && first.normal.dot(a3) * last.normal.dot(a3) <= 0;
}

/// Prepares the obstacle for the distances of all owned nodes.
void prepare(const Moving& moving, const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  if (!moving.before.is_searched()) return;
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    places.push_back(discrete.points[i].phi + assembly::node_values(y, i).head<3>());
  moving.before.prepare(places);
  moving.after.prepare(places);
}

}  // namespace

bool may_pass(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double from, double to) {
  const MPI_Comm comm = discrete.space().layout->comm;
  bool may = false;
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
    for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) {
      const obstacle::Obstacle& obstacle = discrete.obstacles_at_start.all[k];
      if (obstacle.motions.empty() || obstacle.is_plane()) continue;
      const double position = discrete.state.position(k) + discrete.way_pressed(k);
      const Moving moving{obstacle.standing(from, position), obstacle.standing(to, position)};
      prepare(moving, discrete, y);
      for (std::size_t i = 0; !may && i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
        const assembly::Vector6 now = assembly::node_values(y, i);
        Vector3d a3 = discrete.points[i].a3;
        if (discrete.has_finite_rotations()) a3 += now.tail<3>();
        may = may_pass_at(moving, discrete.points[i], discrete.points[i].phi + now.head<3>(), a3);
      }
    }
  });
  return algebra::sum_over_ranks(std::int64_t{may}, comm) > 0;
}

double next_part(const assembly::DiscreteShell& discrete, const algebra::Vector& y, const problem::Instant& from,
                 const problem::Instant& to, double done) {
  constexpr double least = 0x1p-10;
  const auto time = [&](double part) { return problem::between(from, to, part).time; };
  double next = 1;
  while (next - done > least && may_pass(discrete, y, time(done), time(next))) next = done + (next - done) / 2;
  return next;
}

}  // namespace plastron::computation
