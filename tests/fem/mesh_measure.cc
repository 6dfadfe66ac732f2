#include "fem/mesh_measure.hpp"

#include <gtest/gtest.h>
#include <plastron/fem/basis.hpp>

#include <algorithm>
#include <set>

namespace plastron::fem {

namespace {

double jacobian(const PlaneJet& f) { return f.d[0][0] * f.d[1][1] - f.d[0][1] * f.d[1][0]; }

const CellMap& map_of(const Space& space, const Cell& cell) {
  return space.coarse->cells[static_cast<std::size_t>(cell.coarse)].map;
}

/// int over [corner, corner + size]^2 of the Jacobian of a map.
double area(const CellMap& map, const Vector2d& corner, double size) {
  static const Rule rule = gauss(16);
  double sum = 0;
  for (std::size_t i = 0; i < rule.points.size(); ++i)
    for (std::size_t j = 0; j < rule.points.size(); ++j)
      sum +=
          rule.weights[i] * rule.weights[j] * jacobian(map(corner + size * Vector2d(rule.points[i], rule.points[j])));
  return sum * size * size;
}

struct Side {
  std::size_t cell;
  int side;
  bool forward;  ///< runs from the lower to the higher vertex number
};

std::map<std::pair<int, int>, std::vector<Side>> sides_of(const CoarseMesh& mesh) {
  constexpr int ends[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int s = 0; s < 4; ++s) {
      const int a = mesh.cells[c].vertices[ends[s][0]], b = mesh.cells[c].vertices[ends[s][1]];
      sides[std::minmax(a, b)].push_back({c, s, a < b});
    }
  return sides;
}

}  // namespace

double area(const CoarseMesh& mesh) {
  double sum = 0;
  for (const CoarseCell& cell : mesh.cells) sum += area(cell.map, Vector2d::Zero(), 1);
  return sum;
}

double owned_area(const Space& space) {
  double sum = 0;
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    sum += area(map_of(space, space.cells[c]), space.cells[c].corner, space.cells[c].size);
  return sum;
}

std::map<std::string, double> owned_boundary_lengths(const Space& space) {
  static const Rule rule = gauss(12);
  std::map<std::string, double> lengths;
  for (const BoundaryFace& face : space.faces) {
    if (face.cell >= space.owned_cells) continue;
    const Cell& cell = space.cells[face.cell];
    double& length =
        lengths[face.boundary < 0 ? "" : space.coarse->boundaries[static_cast<std::size_t>(face.boundary)]];
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const PlaneJet f = map_of(space, cell)(cell.corner + cell.size * side_point(face.side, rule.points[q]));
      length += rule.weights[q] * cell.size * f.d[face.side < 2 ? 1 : 0].norm();
    }
  }
  return lengths;
}

Vector2d position(const Space& space, const Cell& cell, const Vector2d& xi) {
  return map_of(space, cell)(cell.corner + cell.size * xi).value;
}

void expect_cells_fit(const CoarseMesh& mesh) {
  for (const CoarseCell& cell : mesh.cells) {
    for (int k = 0; k < 4; ++k) {
      const Vector2d corner = cell.map(Vector2d(k % 2, k / 2)).value;
      EXPECT_LT((corner - mesh.vertices[static_cast<std::size_t>(cell.vertices[k])]).norm(), 1e-14);
    }
    for (const double s : {0.0, 0.3, 1.0})
      for (const double t : {0.0, 0.6, 1.0}) EXPECT_GT(jacobian(cell.map(Vector2d(s, t))), 0);
    EXPECT_GE(cell.region, 0);
    EXPECT_LT(static_cast<std::size_t>(cell.region), mesh.regions.size());
  }
  const auto sides = sides_of(mesh);
  for (const auto& [ends, all] : sides) {
    ASSERT_LE(all.size(), 2u);
    for (const double t : {0.0, 0.2, 0.5, 0.9}) {
      const auto at = [&](const Side& s) {
        return mesh.cells[s.cell].map(side_point(s.side, s.forward ? t : 1 - t)).value;
      };
      EXPECT_LT((at(all.front()) - at(all.back())).norm(), 1e-14);
    }
  }
  for (const BoundaryEdge& edge : mesh.edges) {
    EXPECT_TRUE(sides.contains(std::minmax(edge.vertices[0], edge.vertices[1])));
    EXPECT_LT(static_cast<std::size_t>(edge.boundary), mesh.boundaries.size());
  }
}

}  // namespace plastron::fem
