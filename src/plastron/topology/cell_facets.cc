#include <plastron/topology/cell_facets.hpp>

#include <Eigen/Geometry>

#include <algorithm>

namespace plastron::topology {

namespace {

std::vector<std::array<int, 3>> lattice_triangles(mesh::Shape shape, int order) {
  // Row j of the triangle follows rows of order + 1, order, ... nodes.
  const auto index = [&](int i, int j) {
    return shape == mesh::Shape::triangle ? j * (order + 1) - j * (j - 1) / 2 + i : j * (order + 1) + i;
  };
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j < order; ++j)
    for (int i = 0; i < (shape == mesh::Shape::triangle ? order - j : order); ++i) {
      triangles.push_back({index(i, j), index(i + 1, j), index(i, j + 1)});
      if (shape == mesh::Shape::quadrilateral || i + j + 1 < order)
        triangles.push_back({index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return triangles;
}

std::vector<SpaceBox> boxes_of(const SpaceMesh& mesh) {
  std::vector<SpaceBox> boxes(mesh.cells.size());
  for (std::size_t c = 0; c < boxes.size(); ++c)
    for (const std::int32_t n : mesh.cells[c].nodes) boxes[c].add(mesh.nodes[n]);
  return boxes;
}

}  // namespace

// Regions of the triangle: C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
Vector3d nearest_point(const std::array<Vector3d, 3>& triangle, const Vector3d& point) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  return a + (vb * ab + vc * ac) / (va + vb + vc);
}

std::optional<double> passage(const std::array<Vector3d, 3>& triangle, const Vector3d& from, const Vector3d& to) {
  const Vector3d ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0], normal = ab.cross(ac),
                 along = to - from;
  const double slope = normal.dot(along);
  if (std::abs(slope) <= 1e-9 * normal.norm() * along.norm()) return {};
  const double t = normal.dot(triangle[0] - from) / slope;
  const Vector3d p = from + t * along - triangle[0];
  const double u = p.cross(ac).dot(normal) / normal.squaredNorm(), v = ab.cross(p).dot(normal) / normal.squaredNorm();
  if (u < 0 || v < 0 || u + v > 1) return {};
  return t;
}

CellFacets::CellFacets(const SpaceMesh& mesh) : mesh_(mesh), tree_(boxes_of(mesh)) {
  for (const SurfaceCell& cell : mesh.cells) {
    if (!triangles_.contains(cell.order)) triangles_[cell.order] = lattice_triangles(mesh.shape, cell.order);
    const auto corners = corner_nodes(mesh.shape, cell);
    const auto side = [&](int from, int to) { return Vector3d(mesh.nodes[corners[to]] - mesh.nodes[corners[from]]); };
    normals_.push_back(
        (mesh.shape == mesh::Shape::triangle ? side(0, 1).cross(side(0, 2)) : side(0, 3).cross(side(1, 2)))
            .normalized());
    double longest = 0;
    for (int s = 0; s < mesh::corner_count(mesh.shape); ++s) {
      const auto [from, to] = mesh::side_corners(mesh.shape, s);
      longest = std::max(longest, side(from, to).norm());
    }
    sizes_.push_back(longest);
  }
}

std::array<Vector3d, 3> CellFacets::triangle(std::size_t cell, const std::array<int, 3>& places) const {
  const auto& nodes = mesh_.cells[cell].nodes;
  return {mesh_.nodes[nodes[places[0]]], mesh_.nodes[nodes[places[1]]], mesh_.nodes[nodes[places[2]]]};
}

Vector3d CellFacets::nearest(std::size_t cell, const Vector3d& point) const {
  Vector3d best = Vector3d::Constant(HUGE_VAL);
  double least = HUGE_VAL;
  for (const auto& places : triangles_.at(mesh_.cells[cell].order)) {
    const Vector3d p = nearest_point(triangle(cell, places), point);
    const double squared = (p - point).squaredNorm();
    if (squared < least) {
      least = squared;
      best = p;
    }
  }
  return best;
}

std::optional<Vector3d> CellFacets::crossing(std::size_t cell, const Vector3d& from, const Vector3d& to) const {
  constexpr double rounding = 1e-6;  // an end that lies on the cell does not cross it
  for (const auto& places : triangles_.at(mesh_.cells[cell].order))
    if (const auto t = passage(triangle(cell, places), from, to); t && *t > rounding && *t < 1 - rounding)
      return from + *t * (to - from);
  return {};
}

Vector3d CellFacets::centre(std::size_t cell) const {
  const auto corners = corner_nodes(mesh_.shape, mesh_.cells[cell]);
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < mesh::corner_count(mesh_.shape); ++k) sum += mesh_.nodes[corners[k]];
  return nearest(cell, sum / mesh::corner_count(mesh_.shape));
}

}  // namespace plastron::topology
