#include "fem/mesh_measure.hpp"

#include <gtest/gtest.h>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace plastron::fem {

namespace {

double jacobian(const geometry::PlaneJet& f) { return f.d[0][0] * f.d[1][1] - f.d[0][1] * f.d[1][0]; }

const mesh::CellMap& map_of(const Space& space, const Cell& cell) {
  return space.coarse->cells[static_cast<std::size_t>(cell.coarse)].map;
}

/// Points and weights on the reference cell, of much higher exactness than necessary.
mesh::TriangleRule fine_rule(mesh::Shape shape) {
  if (shape == mesh::Shape::triangle) return mesh::triangle_rule(30);
  const mesh::Rule line = mesh::gauss(16);
  mesh::TriangleRule rule;
  for (std::size_t i = 0; i < line.points.size(); ++i)
    for (std::size_t j = 0; j < line.points.size(); ++j) {
      rule.points.emplace_back(line.points[i], line.points[j]);
      rule.weights.push_back(line.weights[i] * line.weights[j]);
    }
  return rule;
}

/// int of the Jacobian of a map over the part corner + size xi of its reference cell.
double area(mesh::Shape shape, const mesh::CellMap& map, const Vector2d& corner, double size) {
  const mesh::TriangleRule rule = fine_rule(shape);
  double sum = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    sum += rule.weights[q] * jacobian(map(corner + size * rule.points[q]));
  return sum * size * size;
}

struct Side {
  std::size_t cell;
  int side;
  bool forward;  ///< runs from the lower to the higher vertex number
};

std::map<std::pair<int, int>, std::vector<Side>> sides_of(const mesh::CoarseMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int s = 0; s < mesh::corner_count(mesh.shape); ++s) {
      const auto ends = mesh::side_corners(mesh.shape, s);
      const int a = mesh.cells[c].vertices[ends[0]], b = mesh.cells[c].vertices[ends[1]];
      sides[std::minmax(a, b)].push_back({c, s, a < b});
    }
  return sides;
}

}  // namespace

double area(const mesh::CoarseMesh& mesh) {
  double sum = 0;
  for (const mesh::CoarseCell& cell : mesh.cells) sum += area(mesh.shape, cell.map, Vector2d::Zero(), 1);
  return sum;
}

double owned_area(const Space& space) {
  double sum = 0;
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    sum += area(space.shape(), map_of(space, space.cells[c]), space.cells[c].corner, space.cells[c].size);
  return sum;
}

std::map<std::string, double> owned_boundary_lengths(const Space& space) {
  static const mesh::Rule rule = mesh::gauss(12);
  std::map<std::string, double> lengths;
  for (const BoundarySide& edge : space.sides) {
    if (edge.cell >= space.owned_cells) continue;
    const Cell& cell = space.cells[edge.cell];
    double& length =
        lengths[edge.boundary < 0 ? "" : space.coarse->boundaries[static_cast<std::size_t>(edge.boundary)]];
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Vector2d xi = mesh::side_point(space.shape(), edge.side, rule.points[q]);
      const geometry::PlaneJet f = map_of(space, cell)(cell.corner + cell.size * xi);
      const Vector2d along = mesh::side_tangent(space.shape(), edge.side);
      length += rule.weights[q] * std::abs(cell.size) * (along[0] * f.d[0] + along[1] * f.d[1]).norm();
    }
  }
  return lengths;
}

Vector2d position(const Space& space, const Cell& cell, const Vector2d& xi) {
  return map_of(space, cell)(cell.corner + cell.size * xi).value;
}

void expect_cells_fit(const mesh::CoarseMesh& mesh) {
  double size = 1;
  for (const Vector2d& v : mesh.vertices) size = std::max(size, v.lpNorm<Eigen::Infinity>());
  const double rounding = 1e-14 * size;
  for (const mesh::CoarseCell& cell : mesh.cells) {
    for (int k = 0; k < mesh::corner_count(mesh.shape); ++k) {
      const Vector2d at = cell.map(corner(mesh.shape, k)).value;
      EXPECT_LT((at - mesh.vertices[static_cast<std::size_t>(cell.vertices[k])]).norm(), rounding);
    }
    for (const Vector2d& xi : mesh::lattice(mesh.shape, 3)) EXPECT_GT(jacobian(cell.map(xi)), 0);
    EXPECT_GE(cell.region, 0);
    EXPECT_LT(static_cast<std::size_t>(cell.region), mesh.regions.size());
  }
  const auto sides = sides_of(mesh);
  for (const auto& [ends, all] : sides) {
    ASSERT_LE(all.size(), 2u);
    for (const double t : {0.0, 0.2, 0.5, 0.9}) {
      const auto at = [&](const Side& s) {
        return mesh.cells[s.cell].map(mesh::side_point(mesh.shape, s.side, s.forward ? t : 1 - t)).value;
      };
      EXPECT_LT((at(all.front()) - at(all.back())).norm(), rounding);
    }
  }
  for (const mesh::BoundaryEdge& edge : mesh.edges) {
    EXPECT_TRUE(sides.contains(std::minmax(edge.vertices[0], edge.vertices[1])));
    EXPECT_LT(static_cast<std::size_t>(edge.boundary), mesh.boundaries.size());
  }
}

}  // namespace plastron::fem
