#include <plastron/computation/passing.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>

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

bool may_pass_at(const Moving& moving, const assembly::NodalPoint& point, const Vector3d& X) {
  // Size of the region around the node: an obstacle may be smaller than the distance of nodes.
  const double around = 2 * std::sqrt(point.weight) + point.thickness / 2, way = moving.way(X).norm();
  if (way <= short_way * point.thickness) return false;
  const obstacle::Nearest first = moving.before.nearest(X);
  if (first.distance - way > around) return false;
  const obstacle::Nearest last = moving.after.nearest(X);
  return (first.distance + last.distance - way) / 2 <= around &&
         first.normal.dot(point.a3) * last.normal.dot(point.a3) <= 0;
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
      for (std::size_t i = 0; !may && i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
        const Vector3d u = assembly::node_values(y, i).head<3>();
        may = may_pass_at(moving, discrete.points[i], discrete.points[i].phi + u);
      }
    }
  });
  return algebra::sum_over_ranks(std::int64_t{may}, comm) > 0;
}

}  // namespace plastron::computation
