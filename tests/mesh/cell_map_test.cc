// The exact maps of coarse cells and their derivatives.
#include <gtest/gtest.h>
#include <plastron/mesh/cell_map.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <cmath>
#include <numbers>

#include "geometry/finite_differences.hpp"

namespace plastron::mesh {
namespace {

using std::numbers::pi;

const std::vector<Vector2d> points{{0.2, 0.3}, {0.5, 0.5}, {0.8, 0.15}, {0.4, 0.9}};

/// Two straight and two round sides. The round ones bulge upwards.
BlendedMap barrel() {
  const double radius = std::sqrt(2.0), from = 3 * pi / 4, to = pi / 4;
  return {.left = Segment{{-1, 0}, {-1, 2}},
          .right = Segment{{1, 0}, {1, 2}},
          .bottom = Arc{{0, -1}, radius, from, to},
          .top = Arc{{0, 1}, radius, from, to}};
}

LagrangeMap quadratic() {
  return {2, {{0, 0}, {0.5, -0.1}, {1, 0.1}, {0.05, 0.5}, {0.55, 0.45}, {1.2, 0.6}, {0, 1}, {0.4, 1.2}, {1.1, 1.1}}};
}

LagrangeMap cubic() {
  LagrangeMap map{3, {}};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) map.nodes.emplace_back(i / 3.0 + 0.03 * i * j, j / 3.0 + 0.02 * std::sin(i + 2 * j));
  return map;
}

template <class Map>
void expect_derivatives_of_values(const Map& map) {
  for (const Vector2d& xi : points) {
    const auto differences =
        geometry::jet_by_differences<Vector2d>([&](double s, double t) { return map(Vector2d(s, t)).value; }, xi);
    EXPECT_LT(geometry::distance(map(xi), differences), 1e-9);
  }
}

template <class Curve>
void expect_curve_derivatives(const Curve& curve) {
  for (const double t : {0.0, 0.3, 1.0}) {
    const Vector2d d = geometry::derivative([&](double s) -> Vector2d { return curve(s).value; }, t);
    const Vector2d dd = geometry::derivative([&](double s) -> Vector2d { return curve(s).d; }, t);
    EXPECT_LT((curve(t).d - d).norm(), 1e-12);
    EXPECT_LT((curve(t).dd - dd).norm(), 1e-11);
  }
}

TEST(Edges, have_the_derivatives_of_their_values) {
  expect_curve_derivatives(Segment{{1, 2}, {3, -1}});
  expect_curve_derivatives(Arc{{1, 2}, 1.5, 0.4, 1.9});
  expect_curve_derivatives(Arc{{1, 2}, 1.5, 1.9, 0.4});
}

TEST(Arc, stays_on_its_circle) {
  const Arc arc{{1, 2}, 1.5, 0.4, 1.9};
  for (const double t : {0.0, 0.21, 0.5, 1.0}) EXPECT_NEAR((arc(t).value - arc.centre).norm(), 1.5, 1e-15);
}

TEST(BlendedMap, has_the_derivatives_of_its_values) { expect_derivatives_of_values(barrel()); }

/// The same map as a polynomial of one degree more.
template <class Map>
Map raised(Shape shape, const Map& map) {
  Map higher{map.order + 1, {}};
  for (const Vector2d& xi : lattice(shape, higher.order)) higher.nodes.push_back(map(xi).value);
  return higher;
}

TEST(LagrangeMap, of_straight_sides_is_that_of_any_order) {
  const LagrangeMap bilinear{1, {{0, 0}, {1, 0.1}, {0.05, 1}, {1.3, 1.2}}};
  const TriangleLagrangeMap linear{1, {{0, 0}, {1, 0.1}, {0.05, 1}}};
  for (const Vector2d& xi : points) {
    EXPECT_LT(geometry::distance(bilinear(xi), raised(Shape::quadrilateral, bilinear)(xi)), 1e-14);
    EXPECT_LT(geometry::distance(linear(xi), raised(Shape::triangle, linear)(xi)), 1e-14);
  }
  expect_derivatives_of_values(bilinear);
}

TEST(TriangleLagrangeMap, has_the_derivatives_of_its_values_and_keeps_its_nodes) {
  for (const int order : {1, 2, 3}) {
    TriangleLagrangeMap map{order, {}};
    for (const Vector2d& p : lattice(Shape::triangle, order))
      map.nodes.emplace_back(p[0] + 0.1 * std::sin(2 * p[1]), p[1] + 0.2 * p[0] * p[0]);
    expect_derivatives_of_values(map);
    const auto at = lattice(Shape::triangle, order);
    for (std::size_t i = 0; i < at.size(); ++i) EXPECT_LT((map(at[i]).value - map.nodes[i]).norm(), 1e-15);
  }
}

TEST(BlendedMap, keeps_every_edge) {
  const BlendedMap map = barrel();
  const auto at = [](const Edge& edge, double t) {
    return std::visit([t](const auto& e) { return e(t).value; }, edge);
  };
  for (const double t : {0.0, 0.2, 0.7, 1.0}) {
    EXPECT_LT((map({0, t}).value - at(map.left, t)).norm(), 1e-15);
    EXPECT_LT((map({1, t}).value - at(map.right, t)).norm(), 1e-15);
    EXPECT_LT((map({t, 0}).value - at(map.bottom, t)).norm(), 1e-15);
    EXPECT_LT((map({t, 1}).value - at(map.top, t)).norm(), 1e-15);
  }
}

TEST(BlendedMap, between_straight_edges_is_bilinear) {
  const Vector2d p00(0, 0), p10(2, 0.3), p01(-0.2, 1), p11(1.7, 1.6);
  const BlendedMap map{
      .left = Segment{p00, p01}, .right = Segment{p10, p11}, .bottom = Segment{p00, p10}, .top = Segment{p01, p11}};
  for (const Vector2d& xi : points) {
    const PlaneJet f = map(xi), g = LagrangeMap{1, {p00, p10, p01, p11}}(xi);
    EXPECT_LT(geometry::distance(f, g), 1e-15);
  }
}

TEST(LagrangeMap, has_the_derivatives_of_its_values) {
  expect_derivatives_of_values(quadratic());
  expect_derivatives_of_values(cubic());
}

TEST(LagrangeMap, goes_through_its_nodes) {
  for (const LagrangeMap& map : {quadratic(), cubic()})
    for (int j = 0; j <= map.order; ++j)
      for (int i = 0; i <= map.order; ++i) {
        const Vector2d xi = Vector2d(i, j) / map.order;
        EXPECT_LT((map(xi).value - map.nodes[static_cast<std::size_t>(j * (map.order + 1) + i)]).norm(), 1e-15);
      }
}

/// The eight ways to map the unit square onto itself.
std::vector<CellMap> seen_from_all_sides(const ExactMap& map) {
  std::vector<CellMap> all;
  for (const Vector2d& origin : {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1), Vector2d(1, 1)})
    for (const bool swapped : {false, true}) {
      const Eigen::Vector2d sign(origin[0] == 0 ? 1 : -1, origin[1] == 0 ? 1 : -1);
      Eigen::Matrix2d axes = sign.asDiagonal();
      if (swapped) axes.col(0).swap(axes.col(1));
      CellMap turned{.map = map};
      turned.origin = origin;
      turned.axes = axes;
      all.push_back(turned);
    }
  return all;
}

TEST(CellMap, seen_through_any_rotation_or_reflection_has_the_derivatives_of_its_values) {
  for (const CellMap& map : seen_from_all_sides(barrel())) expect_derivatives_of_values(map);
  for (const CellMap& map : seen_from_all_sides(quadratic())) expect_derivatives_of_values(map);
}

TEST(CellMap, that_is_turned_covers_the_same_corners) {
  const BlendedMap map = barrel();
  for (const CellMap& turned : seen_from_all_sides(map))
    EXPECT_LT((turned({0, 0}).value - map(turned.origin).value).norm(), 1e-15);
}

}  // namespace
}  // namespace plastron::mesh
