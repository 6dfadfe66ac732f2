#include <plastron/certificate/crossings.hpp>

#include <plastron/certificate/core_depth.hpp>
#include <plastron/certificate/inside_obstacles.hpp>
#include <plastron/certificate/piece.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace plastron::certificate {

namespace {

using Eigen::Vector3d;
using fem::Vector2d;

/// Size of the pieces that are not divided further, as a part of the thickness.
constexpr double least_piece = 1.0 / 64;
/// Search in a cell for an obstacle: number of distances after which the obstacle may pass.
constexpr int most_distances = 8192;
/// Reserves for bulges between nodes, and for tangents that change within a piece.
constexpr double between_nodes = 1.5, within_piece = 1.25;

/// A point of the mid-surface on its path, with the largest distance of the points around it that it represents.
struct Moving {
  Vector3d from, to;
  double reach;

  Vector3d at(double part) const { return from + part * (to - from); }
};

/// An obstacle on the path between two stations.
class Way {
 public:
  Way(const obstacle::Obstacle& obstacle, std::size_t k, const Station& from, const Station& to)
      : obstacle_(obstacle), from_(from.time), to_(to.time) {
    const auto position = [&](const Station& s) { return s.positions.empty() ? 0 : s.positions[k]; };
    start_ = position(from);
    pressed_ = position(to) - start_;
  }

  obstacle::Obstacle at(double part) const {
    return obstacle_.standing(from_ + part * (to_ - from_), start_ + part * pressed_);
  }

  /// Returns the largest speed of a point relative to the obstacle, by part of the path.
  double speed(const Moving& point) const {
    const Vector3d way = point.to - point.from;
    const Vector3d pressed = pressed_ == 0 ? Vector3d(0, 0, 0) : Vector3d(pressed_ * obstacle_.force.normalized());
    double most = 0;
    for (std::size_t m = 0; m < obstacle_.motions.size(); ++m) {
      const auto step = static_cast<double>(m);
      if (!(from_ < step + 1 && to_ > step)) continue;
      const obstacle::Motion& motion = obstacle_.motions[m];
      const double arm =
          std::max((point.from - motion.about).norm(), (point.to - motion.about).norm()) + motion.translation.norm();
      const double time = to_ - from_;
      most = std::max(most, (way - pressed - time * motion.translation).norm() + time * std::abs(motion.angle) * arm);
    }
    const bool rests = obstacle_.motions.empty() || to_ > static_cast<double>(obstacle_.motions.size()) || from_ == to_;
    return rests ? std::max(most, (way - pressed).norm()) : most;
  }

 private:
  const obstacle::Obstacle& obstacle_;
  double from_, to_, start_ = 0, pressed_ = 0;
};

/// Search for one obstacle on the paths of points.
class Search {
 public:
  enum class Outcome { clear, unknown, inside_at_start };

  Search(const obstacle::Obstacle& obstacle, std::size_t k, const Station& from, const Station& to)
      : way_(obstacle, k, from, to), is_from_undeformed_(!from.displacement.layout()) {}

  /// Follows the path of a point as far as the obstacle stays away from the points around it; `part` is the end. Where the
  /// obstacle has no distance, as in the middle of some bodies, nothing is known.
  Outcome follow(const Moving& point, double& part) {
    try {
      return advanced(point, part);
    } catch (const obstacle::ObstacleError&) {
      return Outcome::unknown;
    }
  }
  /// Whether the point lies in the obstacle at the start, or as near to it as the points around it.
  bool begins_inside(const Moving& point) const {
    return is_from_undeformed_ && way_.at(0).nearest(point.from).distance <= point.reach;
  }
  bool is_spent() const { return distances_ >= most_distances; }

 private:
  Outcome advanced(const Moving& point, double& part) {
    const double speed = way_.speed(point);
    for (part = 0; distances_ < most_distances; ++distances_) {
      const obstacle::Obstacle now = way_.at(part);
      const Vector3d X = point.at(part);
      const obstacle::Nearest near = now.nearest(X);
      if (part == 0 && is_from_undeformed_ && near.distance + point.reach <= 0) return Outcome::inside_at_start;
      const double rest = (1 - part) * speed;
      double room = near.distance - point.reach;
      if (room < rest) room += core_depth(now, X, near, point.reach + rest);
      if (room >= rest) return Outcome::clear;
      if (!(room > 0)) return Outcome::unknown;
      part += std::max(room / speed, std::numeric_limits<double>::epsilon());
      if (part >= 1) return Outcome::clear;
    }
    return Outcome::unknown;
  }

  Way way_;
  bool is_from_undeformed_;
  int distances_ = 0;
};

/// The paths of the points of the mid-surface.
class Paths {
 public:
  Paths(const assembly::DiscreteShell& discrete, const Station& from, const Station& to)
      : discrete_(discrete), stations_{&from, &to} {}

  /// The path of a cell as a whole, from its nodes.
  Moving cell(std::size_t cell) const {
    const auto nodes = discrete_.space().nodes(cell);
    Moving whole{Vector3d::Zero(), Vector3d::Zero(), 0};
    for (const algebra::LocalIndex node : nodes) {
      whole.from += place(0, node) / static_cast<double>(nodes.size());
      whole.to += place(1, node) / static_cast<double>(nodes.size());
    }
    for (const algebra::LocalIndex node : nodes)
      whole.reach = std::max({whole.reach, between_nodes * (place(0, node) - whole.from).norm(),
                              between_nodes * (place(1, node) - whole.to).norm()});
    return whole;
  }

  /// The path of a piece of a cell: the points whose coordinates differ from xi by at most `half`.
  Moving piece(std::size_t cell, const Vector2d& xi, double half) const {
    const energy::ShellOperator& shell = discrete_.shell;
    const element::BasisAt basis = element::basis_at(shell.space().shape(), shell.space().degree, {xi});
    geometry::Frame frame;
    shell.surface().frames(shell.space().cells[cell], {&xi, 1}, {&frame, 1}, false);
    Moving moving{frame.phi, frame.phi, 0};
    const auto move = [&](const Station& station, Vector3d& X) {
      double stretch = frame.a_cov[0].norm() + frame.a_cov[1].norm();
      if (station.displacement.layout()) {
        const auto fields = shell.interpolation().fields(cell, basis, shell.interpolation().bases(cell, basis.xi),
                                                         shell.gather(cell, station.displacement));
        X += fields.value.row(0).head<3>().transpose();
        stretch = (frame.a_cov[0] + fields.d1.row(0).head<3>().transpose()).norm() +
                  (frame.a_cov[1] + fields.d2.row(0).head<3>().transpose()).norm();
      }
      moving.reach = std::max(moving.reach, within_piece * half * stretch);
    };
    move(*stations_[0], moving.from);
    move(*stations_[1], moving.to);
    return moving;
  }

 private:
  Vector3d place(std::size_t station, algebra::LocalIndex node) const {
    const auto i = static_cast<std::size_t>(node);
    Vector3d X = discrete_.points[i].phi;
    if (stations_[station]->displacement.layout())
      X += assembly::node_values(stations_[station]->displacement, i).head<3>();
    return X;
  }

  const assembly::DiscreteShell& discrete_;
  std::array<const Station*, 2> stations_;
};

/// Searches a cell piece by piece; pieces that are not clear are divided.
std::optional<Crossing> crossing_in(const assembly::DiscreteShell& discrete, std::size_t cell, const Paths& paths,
                                    std::size_t k, Search search) {
  using enum Search::Outcome;
  const fem::Space& space = discrete.space();
  double part = 0;
  if (search.follow(paths.cell(cell), part) == clear) return {};
  const double least = least_piece * discrete.points[static_cast<std::size_t>(space.nodes(cell)[0])].thickness;
  std::vector<Piece> open{{{0.5, 0.5}, 0.5}};
  while (!open.empty()) {
    const Piece whole = open.back(), piece = whole.inside(space.shape());
    open.pop_back();
    const Moving moving = paths.piece(cell, piece.centre, piece.half);
    if (search.follow(moving, part) != unknown) continue;
    if (!search.is_spent() && moving.reach > least) {
      whole.divide(space.shape(), open);
    } else if (search.is_spent() || !search.begins_inside(moving)) {
      Crossing crossing{.cell = cell, .obstacle = k, .x = Vector2d::Zero(), .part = part};
      discrete.shell.surface().positions(space.cells[cell], {&piece.centre, 1}, {&crossing.x[0], 1},
                                         {&crossing.x[1], 1});
      return crossing;
    }
  }
  return {};
}

}  // namespace

std::vector<Crossing> crossings(const assembly::DiscreteShell& discrete, const Station& from, const Station& to) {
  std::vector<Crossing> found;
  if (discrete.obstacles.are_linear) return found;
  const std::vector<char> of_bodies = cells_of_bodies(discrete.space());
  const Paths paths(discrete, from, to);
  for (std::size_t k = 0; k < discrete.obstacles_at_start.all.size(); ++k) {
    const obstacle::Obstacle& obstacle = discrete.obstacles_at_start.all[k];
    if (!has_far_side(obstacle) || obstacle.has_bed()) continue;
    for (std::size_t cell = 0; cell < discrete.space().owned_cells; ++cell) {
      if (of_bodies[cell]) continue;
      if (const auto crossing = crossing_in(discrete, cell, paths, k, {obstacle, k, from, to}))
        found.push_back(*crossing);
    }
  }
  return found;
}

}  // namespace plastron::certificate
