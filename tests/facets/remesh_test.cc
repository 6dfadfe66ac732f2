// Cells on surfaces of triangles: they conform, they lie on the facets, they keep folds and borders, and they are good.
#include "facets/surfaces.hpp"

#include <plastron/facets/cells.hpp>
#include <plastron/facets/untangle.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <random>

namespace plastron::facets {
namespace {

using namespace surfaces;  // NOLINT: builders of surfaces

struct Part {
  const char* name;
  TriangleMesh mesh;
  double size;
};

std::vector<Part> parts() {
  return {{"sphere", sphere(12), 0.15},  {"tube", tube(36), 0.1},
          {"fine tube", tube(180), 0.1}, {"torus", torus(16), 0.3},
          {"cube", cube(), 0.15},        {"angle", star({0, 1.9}), 0.1},
          {"plate", star({0}, 3), 0.1},  {"hole", plate_with_small_hole(36), 0.2}};
}

Cells cells_of(const Facets& facets, double size) { return quadrilaterals(facets, size, "part"); }

using Ends = std::array<int, 2>;
Ends ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

std::map<Ends, int> side_counts(const Cells& cells) {
  std::map<Ends, int> counts;
  for (const auto& q : cells.quadrilaterals)
    for (std::size_t k = 0; k < 4; ++k) ++counts[ascending(q[k], q[(k + 1) % 4])];
  return counts;
}

/// The least and the largest angle of all cells [degrees], measured round the cell's normal.
std::array<double, 2> angles(const Cells& cells) {
  double least = 360, largest = 0;
  for (const auto& q : cells.quadrilaterals) {
    const auto x = [&](std::size_t k) { return cells.points[q[k % 4]]; };
    const Vector3d normal = (x(2) - x(0)).cross(x(3) - x(1));
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d next = x(k + 1) - x(k), last = x(k + 3) - x(k), across = next.cross(last);
      double angle = std::atan2(across.norm(), next.dot(last)) * 180 / pi;
      if (across.dot(normal) < 0) angle = 360 - angle;
      least = std::min(least, angle);
      largest = std::max(largest, angle);
    }
  }
  return {least, largest};
}

double area(const Cells& cells) {
  double sum = 0;
  for (const auto& q : cells.quadrilaterals) {
    const auto x = [&](std::size_t k) { return cells.points[q[k]]; };
    sum += (x(2) - x(0)).cross(x(3) - x(1)).norm() / 2;
  }
  return sum;
}

TEST(Remesh, MakesCellsThatShareWholeSides) {
  for (const auto& [name, mesh, size] : parts()) {
    const Facets facets = find_facets(mesh, pi / 6, name);
    const Cells cells = cells_of(facets, size);
    std::map<Ends, int> kind_at;
    for (const auto& [ends, curve] : cells.lines)
      kind_at[ascending(ends[0], ends[1])] = facets.curves[curve].kind == CurveKind::border ? 1 : 2;
    for (const auto& [ends, count] : side_counts(cells)) {
      const auto line = kind_at.find(ends);
      EXPECT_EQ(count, line == kind_at.end() ? 2 : line->second) << name;
    }
  }
}

TEST(Remesh, MakesCellsWithoutSharpAngles) {
  for (const auto& [name, mesh, size] : parts()) {
    const auto [least, largest] = angles(cells_of(find_facets(mesh, pi / 6, name), size));
    // The hole is smaller than the cells round it.
    const bool is_hole = std::string(name) == "hole";
    EXPECT_GT(least, is_hole ? 5 : 15) << name;
    EXPECT_LT(largest, is_hole ? 175 : 160) << name;
  }
}

TEST(Remesh, KeepsTheSurface) {
  for (const auto& [name, mesh, size] : parts()) {
    const Facets facets = find_facets(mesh, pi / 6, name);
    const Cells cells = cells_of(facets, size);
    EXPECT_NEAR(area(cells) / area_of(facets.mesh), 1, 0.03) << name;
    const FacetProjection projection(facets);
    double distance = 0;
    for (const Vector3d& p : cells.points) distance = std::max(distance, (projection.on_facets(p) - p).norm());
    EXPECT_LT(distance, 1e-8) << name;
    for (const auto& [ends, curve] : cells.lines)
      for (const int end : ends)
        EXPECT_LT((projection.on_curve(cells.points[end], curve) - cells.points[end]).norm(), 1e-8) << name;
  }
}

TEST(Remesh, MakesCellsOfTheSize) {
  for (const auto& [name, mesh, size] : parts()) {
    if (std::string(name) == "hole") continue;  // its border is finer
    const Cells cells = cells_of(find_facets(mesh, pi / 6, name), size);
    const double mean = std::sqrt(area(cells) / static_cast<double>(cells.quadrilaterals.size()));
    EXPECT_NEAR(mean / size, 1, 0.2) << name;
  }
}

TEST(Remesh, KeepsFacesAndCurvesApart) {
  const Facets facets = find_facets(cube(), pi / 6, "cube");
  const Cells cells = cells_of(facets, 0.15);
  std::vector<double> areas(6, 0);
  for (std::size_t i = 0; i < cells.quadrilaterals.size(); ++i) {
    const auto& q = cells.quadrilaterals[i];
    const auto x = [&](std::size_t k) { return cells.points[q[k]]; };
    areas[cells.face_of[i]] += (x(2) - x(0)).cross(x(3) - x(1)).norm() / 2;
  }
  for (const double of_face : areas) EXPECT_NEAR(of_face, 1, 1e-9);
  std::vector<Vector3d> sums(12, Vector3d::Zero());
  for (const auto& [ends, curve] : cells.lines) sums[curve] += cells.points[ends[1]] - cells.points[ends[0]];
  for (const Vector3d& sum : sums) EXPECT_NEAR(sum.norm(), 1, 1e-9);  // all of its lines in one direction
}

TEST(Remesh, IsTheSameOnEveryRun) {
  const Facets facets = find_facets(tube(36), pi / 6, "tube");
  const Cells first = cells_of(facets, 0.1), second = cells_of(facets, 0.1);
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.quadrilaterals, second.quadrilaterals);
}

/// A square of 8 x 8 pairs of triangles in the plane; its border are lines.
Remeshed plane_square() {
  constexpr int n = 8;
  const auto at = [](int i, int j) { return j * (n + 1) + i; };
  Remeshed mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.points.emplace_back(i, j, 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.face_of.assign(mesh.triangles.size(), 0);
  for (int i = 0; i < n; ++i)
    for (const std::array<int, 2>& ends : {std::array{at(i, 0), at(i + 1, 0)}, std::array{at(n, i), at(n, i + 1)},
                                           std::array{at(i + 1, n), at(i, n)}, std::array{at(0, i + 1), at(0, i)}})
      mesh.lines.push_back({ends, 0});
  return mesh;
}

TEST(Untangling, TurnsBackTrianglesWhoseCornersWereMovedAcrossTheirNeighbours) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> inner(1, 7);
  std::uniform_real_distribution<double> moved(-1.5, 1.5);
  for (int k = 0; k < 40; ++k) {
    Remeshed mesh = plane_square();
    for (int m = 0; m < 3; ++m) {
      Vector3d& point = mesh.points[static_cast<std::size_t>(9 * inner(random) + inner(random))];
      for (int d = 0; d < 2; ++d) point[d] = std::clamp(point[d] + moved(random), 0.05, 7.95);
    }
    untangle(mesh);
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3d to_b = mesh.points[b] - mesh.points[a], to_c = mesh.points[c] - mesh.points[a];
      const double twice = to_b[0] * to_c[1] - to_b[1] * to_c[0];
      EXPECT_GT(twice, 0);
      area += twice / 2;
    }
    EXPECT_NEAR(area, 64, 1e-12);
    EXPECT_EQ(mesh.lines.size(), 32U);
    EXPECT_EQ(mesh.face_of.size(), mesh.triangles.size());
  }
}

}  // namespace
}  // namespace plastron::facets
