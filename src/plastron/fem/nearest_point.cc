// The point of the mid-surface nearest to a point in space: samples of each cell in reach, then Newton's method for the
// square of the distance, without the curvature of the surface (Gauss and Newton), from the best samples.
#include <plastron/fem/surface.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace plastron::fem {

namespace {

using geometry::Vector3d;

class Search {
 public:
  Search(const Surface& surface, const Vector3d& point)
      : surface_(surface), shape_(surface.coarse().shape), point_(point) {}

  NearestPoint operator()() {
    for (const std::size_t cell : cells_in_reach()) search(static_cast<int>(cell));
    return nearest_;
  }

 private:
  /// Returns the cells that may hold the nearest point: with charts all cells; on a mesh in space each cell that has a
  /// node nearer than the nearest node plus the cell's extent.
  std::vector<std::size_t> cells_in_reach() const {
    const auto& cells = surface_.coarse().cells;
    std::vector<std::size_t> all(cells.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (!surface_.has_directors()) return all;
    const mesh::SurfacePatches& patches = *surface_.coarse().patches;
    std::vector<double> least(cells.size());
    double most = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto& nodes = patches.patches[static_cast<std::size_t>(cells[c].patch)].nodes;
      const auto place = [&](std::int32_t node) { return patches.positions[static_cast<std::size_t>(node)]; };
      double nearest = std::numeric_limits<double>::infinity(), extent = 0;
      for (const std::int32_t node : nodes) {
        nearest = std::min(nearest, (place(node) - point_).norm());
        extent = std::max(extent, (place(node) - place(nodes.front())).norm());
      }
      least[c] = nearest - extent;
      most = std::min(most, nearest);
    }
    std::erase_if(all, [&](std::size_t c) { return least[c] > most; });
    return all;
  }

  void search(int cell) {
    constexpr int divisions = 8;
    constexpr std::size_t starts = 3;
    const std::vector<Vector2d> xi = mesh::lattice(shape_, divisions);
    std::vector<geometry::Frame> frames(xi.size());
    surface_.frames({.coarse = cell}, xi, frames, false);
    std::vector<std::size_t> order(xi.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return (frames[i].phi - point_).norm(); });
    for (std::size_t k = 0; k < std::min(starts, order.size()); ++k) descend(cell, xi[order[k]]);
  }

  void descend(int cell, Vector2d xi) {
    constexpr int steps = 50;
    geometry::Frame at = surface_.frame({.coarse = cell}, xi, false);
    for (int step = 0; step < steps; ++step) {
      const Vector3d off = point_ - at.phi;
      const Vector2d slope(off.dot(at.a_cov[0]), off.dot(at.a_cov[1]));
      const Vector2d newton = at.metric_con * slope;
      bool is_shorter = false;
      for (double length = 1; length > 1e-4 && !is_shorter; length /= 2) {
        // Along a side the way goes on inside of it.
        for (const Vector2d& way :
             {newton, Vector2d(slope[0] / at.metric_cov(0, 0), 0), Vector2d(0, slope[1] / at.metric_cov(1, 1))}) {
          const Vector2d next = mesh::put_inside(shape_, xi + length * way);
          if ((next - xi).norm() < 1e-14) continue;
          const geometry::Frame there = surface_.frame({.coarse = cell}, next, false);
          if (!((point_ - there.phi).norm() < off.norm())) continue;
          xi = next;
          at = there;
          is_shorter = true;
          break;
        }
      }
      if (!is_shorter) break;
    }
    note({.location = {cell, xi}, .point = {}, .place = at.phi, .distance = (point_ - at.phi).norm()});
  }

  void note(NearestPoint found) {
    constexpr double equal = 1e-9;  // relative: points on a side belong to the first cell
    if (!(found.distance < nearest_.distance - equal * (nearest_.place - found.place).norm())) return;
    std::array<double, 1> x, y;
    surface_.positions({.coarse = found.location.coarse}, {&found.location.xi, 1}, x, y);
    found.point = {x[0], y[0]};
    nearest_ = found;
  }

  const Surface& surface_;
  mesh::Shape shape_;
  Vector3d point_;
  NearestPoint nearest_{
      .location = {}, .point = {}, .place = Vector3d::Zero(), .distance = std::numeric_limits<double>::infinity()};
};

}  // namespace

NearestPoint nearest_point(const Surface& surface, const Vector3d& point) { return Search(surface, point)(); }

NearestPoint nearest_kept_node(const Surface& surface, int degree, const Vector3d& point) {
  const mesh::Shape shape = surface.coarse().shape;
  const std::vector<Vector2d> xi = mesh::lattice(shape, degree % 2 == 0 ? 2 : 1);
  std::vector<geometry::Frame> frames(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  NearestPoint nearest{
      .location = {}, .point = {}, .place = Vector3d::Zero(), .distance = std::numeric_limits<double>::infinity()};
  for (std::size_t c = 0; c < surface.coarse().cells.size(); ++c) {
    const Cell cell{.coarse = static_cast<int>(c)};
    surface.frames(cell, xi, frames, false);
    for (std::size_t k = 0; k < xi.size(); ++k) {
      const double distance = (frames[k].phi - point).norm();
      if (!(distance < nearest.distance)) continue;
      surface.positions(cell, xi, x, y);
      nearest = {.location = {cell.coarse, xi[k]}, .point = {x[k], y[k]}, .place = frames[k].phi, .distance = distance};
    }
  }
  return nearest;
}

}  // namespace plastron::fem
