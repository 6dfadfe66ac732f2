// The gap of a face against a half-space (M16).
#include <gtest/gtest.h>
#include <plastron/obstacle/gap.hpp>

#include "geometry/surfaces.hpp"
#include "shell/random_fields.hpp"

namespace plastron::obstacle {
namespace {

using geometry::Frame;
using shell::Random;

constexpr double thickness = 0.2;

/// An oblique half-space, so that errors in coordinates and signs show.
HalfSpace slope() { return {.point = {0.1, -0.2, 0.3}, .normal = Vector3d(1, -2, 2) / 3}; }

template <class Check>
void at_all_points(const Check& check) {
  for (const auto& [name, chart] : geometry::surfaces()) {
    SCOPED_TRACE(name);
    for (const auto& x : geometry::sample_points()) {
      const auto jet = chart(x[0], x[1]);
      check(jet.value, geometry::frame_at(jet).a3);
    }
  }
}

TEST(HalfSpace, distance_is_signed_and_grows_along_its_gradient) {
  const HalfSpace h = slope();
  EXPECT_NEAR(h.nearest(h.point).distance, 0, 1e-16);
  EXPECT_NEAR(h.nearest(h.point + 2 * h.normal).distance, 2, 1e-15);
  EXPECT_NEAR(h.nearest(h.point - 2 * h.normal).distance, -2, 1e-15);
  EXPECT_NEAR(h.nearest(h.point).normal.norm(), 1, 1e-15);
}

TEST(Obstacle, answers_with_the_derivatives_of_its_distance) {
  const Vector3d X(0.7, -0.4, 1.1);
  for (const Shape& shape : {Shape(slope()), Shape(Ball{.centre = {0.1, 0.2, -0.3}, .radius = 0.5}),
                             Shape(Ball{.centre = {0.1, 0.2, -0.3}, .radius = 4, .inside = true})}) {
    const Obstacle body{.shape = shape, .placement = {.translation = {0.1, 0.05, -0.15}}};
    const Nearest at = body.nearest(X);
    EXPECT_GT(at.distance, 0);
    EXPECT_NEAR(at.normal.norm(), 1, 1e-15);
    constexpr double h = 1e-5;
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      const Nearest ahead = body.nearest(X + step), behind = body.nearest(X - step);
      EXPECT_NEAR((ahead.distance - behind.distance) / (2 * h), at.normal[k], 1e-9);
      EXPECT_LT(((ahead.normal - behind.normal) / (2 * h) - at.curvature.col(k)).norm(), 1e-8);
    }
  }
}

TEST(Obstacle, goes_its_way_in_proportion_to_time) {
  const Vector3d way(0.2, 0.1, -0.3), X(0.7, -0.4, 1.1);
  const Obstacle body{.shape = slope(), .motions = {{.translation = way}}};
  for (const double time : {0.0, 0.25, 1.0})
    EXPECT_NEAR(body.standing(time).nearest(X + time * way).distance, slope().nearest(X).distance, 1e-15);
  EXPECT_GT(std::abs(body.standing(1).nearest(X).distance - body.standing(0).nearest(X).distance), 0.1);
}

TEST(Gap, of_a_plate_over_a_table_is_the_height_of_its_face) {
  const HalfSpace table{};
  const Vector3d phi(3, 4, 1), up = Vector3d::UnitZ();
  EXPECT_DOUBLE_EQ(gap_at(Obstacle{.shape = table, .face = Face::lower}, {phi, up, thickness}).initial,
                   1 - thickness / 2);
  EXPECT_DOUBLE_EQ(gap_at(Obstacle{.shape = table, .face = Face::upper}, {phi, up, thickness}).initial,
                   1 + thickness / 2);
  EXPECT_DOUBLE_EQ(gap_at(Obstacle{.shape = table, .face = Face::upper}, {phi, -up, thickness}).initial,
                   1 - thickness / 2);  // faces are seen along a_3
}

TEST(Gap, is_that_of_the_touching_face) {
  at_all_points([](const Vector3d& phi, const Vector3d& a3) {
    for (const Face face : {Face::lower, Face::upper}) {
      const Gap g = gap_at(Obstacle{.shape = slope(), .face = face}, {phi, a3, thickness});
      const Vector3d point = phi + (face == Face::lower ? -1 : 1) * thickness / 2 * a3;
      EXPECT_LT((g.contact_point - point).norm(), 1e-15);
      EXPECT_NEAR(g.initial, slope().nearest(point).distance, 1e-15);
      EXPECT_EQ(g(Vector3d::Zero(), Vector3d::Zero()), g.initial);
    }
  });
}

TEST(Gap, changes_under_a_motion_as_the_distance_of_the_moved_face) {  // exact for a half-space
  Random random;
  at_all_points([&](const Vector3d& phi, const Vector3d& a3) {
    for (const Face face : {Face::lower, Face::upper}) {
      const Gap g = gap_at(Obstacle{.shape = slope(), .face = face}, {phi, a3, thickness});
      const Vector3d u = random.vector(), r = random.vector();
      EXPECT_NEAR(g(u, r), slope().nearest(phi + u + g.z * (a3 + r)).distance, 1e-14);
    }
  });
}

TEST(Gap, under_a_rigid_motion_is_the_distance_of_the_rigidly_moved_point) {
  Random random;
  at_all_points([&](const Vector3d& phi, const Vector3d& a3) {
    for (const Face face : {Face::lower, Face::upper}) {
      const Gap g = gap_at(Obstacle{.shape = slope(), .face = face}, {phi, a3, thickness});
      const Vector3d c = random.vector(), w = random.vector();
      const double moved = slope().nearest(g.contact_point + c + w.cross(g.contact_point)).distance;
      EXPECT_NEAR(g(c + w.cross(phi), w.cross(a3)), moved, 1e-14);
    }
  });
}

/// A point of a flat shell of thickness 0.2 with its lower face at -0.1, and the distance to a small body under its mid-surface.
FaceGap over(const Shape& shape, double x, Face face = Face::nearer) {
  return face_gap(Obstacle{.shape = shape, .face = face}, {{x, 0, 0}, Vector3d::UnitZ(), thickness});
}

TEST(FaceGap, of_a_body_thinner_than_the_shell_is_to_its_side_that_looks_at_the_mid_surface) {
  const Ball ball{.centre = {0, 0, -0.05}, .radius = 0.03};        // the face is below its centre
  const Box sheet{.centre = {0, 0, -0.09}, .size = {1, 1, 0.06}},  // the face is nearer to its lower side
      blade{.centre = {0, 0, -0.55}, .size = {0.04, 1, 1}};        // the face is nearer to its walls
  for (const auto& [shape, top] : {std::pair<Shape, double>{ball, -0.02}, {sheet, -0.06}, {blade, -0.05}})
    for (const Face face : {Face::nearer, Face::lower}) {
      const FaceGap gap = over(shape, 0, face);
      EXPECT_LT((gap.normal - Vector3d::UnitZ()).norm(), 1e-12);
      EXPECT_NEAR(gap.distance, -0.1 - top, 1e-12);
      EXPECT_LE(gap.clearance, 0);
    }
}

TEST(FaceGap, beside_a_body_under_the_mid_surface_is_the_way_to_its_side) {
  const FaceGap gap = over(Ball{.centre = {0, 0, -0.05}, .radius = 0.03}, 0.04);
  EXPECT_NEAR(gap.distance, 0.01, 1e-9);
  EXPECT_NEAR(gap.normal[0], 1, 1e-9);
  EXPECT_GT(gap.clearance, 0);
  EXPECT_NEAR(gap.roundness, 0.03, 1e-9);
}

TEST(FaceGap, of_a_body_that_has_come_past_the_mid_surface_tells_the_face_it_came_through) {
  const Box blade{.centre = {0.0, 0, -0.47}, .size = {0.1, 1, 1}};  // up to 0.03
  EXPECT_NEAR(over(blade, 0.045).distance, -0.13, 1e-12);
  const Box hanging{.centre = {0.0, 0, 0.47}, .size = {0.1, 1, 1}};
  const FaceGap gap = over(hanging, 0.045);
  EXPECT_GT(gap.z, 0);
  EXPECT_NEAR(gap.distance, -0.13, 1e-12);
  EXPECT_LT((gap.normal + Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Passage, is_through_where_an_obstacle_is_on_the_way_and_not_beside_it) {
  const Ball ball{.centre = {0, 0, -0.05}, .radius = 0.03};
  const auto down = [&](double x) {
    return passage(Obstacle{.shape = ball}, {x, 0, 0}, {x, 0, -0.1}, Vector3d::UnitZ());
  };
  EXPECT_TRUE(down(0.01).is_through);
  EXPECT_FALSE(down(0.04).is_through);
  EXPECT_NEAR(down(0.04).clearance, 0.01, 1e-9);
  EXPECT_FALSE(passage(Obstacle{.shape = ball}, {0, 0, 0}, {0.2, 0, 0}, Vector3d::UnitZ()).is_through);
}

}  // namespace
}  // namespace plastron::obstacle
