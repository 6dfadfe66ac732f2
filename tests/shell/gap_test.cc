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

/// A half-space across everything, so that neither coordinates nor signs can hide.
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
  EXPECT_NEAR(h.distance(h.point), 0, 1e-16);
  EXPECT_NEAR(h.distance(h.point + 2 * h.normal), 2, 1e-15);
  EXPECT_NEAR(h.distance(h.point - 2 * h.normal), -2, 1e-15);
  EXPECT_NEAR(h.gradient(h.point).norm(), 1, 1e-15);
}

TEST(Gap, of_a_plate_over_a_table_is_the_height_of_its_face) {
  const HalfSpace table{};
  const Vector3d phi(3, 4, 1), up = Vector3d::UnitZ();
  EXPECT_DOUBLE_EQ(gap_at(table, Face::lower, phi, up, thickness).initial, 1 - thickness / 2);
  EXPECT_DOUBLE_EQ(gap_at(table, Face::upper, phi, up, thickness).initial, 1 + thickness / 2);
  EXPECT_DOUBLE_EQ(gap_at(table, Face::upper, phi, -up, thickness).initial,
                   1 - thickness / 2);  // faces are seen along a_3
}

TEST(Gap, is_that_of_the_touching_face) {
  at_all_points([](const Vector3d& phi, const Vector3d& a3) {
    for (const Face face : {Face::lower, Face::upper}) {
      const Gap g = gap_at(slope(), face, phi, a3, thickness);
      const Vector3d point = phi + (face == Face::lower ? -1 : 1) * thickness / 2 * a3;
      EXPECT_LT((g.contact_point - point).norm(), 1e-15);
      EXPECT_NEAR(g.initial, slope().distance(point), 1e-15);
      EXPECT_EQ(g(Vector3d::Zero(), Vector3d::Zero()), g.initial);
    }
  });
}

TEST(Gap, changes_under_a_motion_as_the_distance_of_the_moved_face) {  // exact for a half-space
  Random random;
  at_all_points([&](const Vector3d& phi, const Vector3d& a3) {
    for (const Face face : {Face::lower, Face::upper}) {
      const Gap g = gap_at(slope(), face, phi, a3, thickness);
      const Vector3d u = random.vector(), r = random.vector();
      EXPECT_NEAR(g(u, r), slope().distance(phi + u + g.z * (a3 + r)), 1e-14);
    }
  });
}

TEST(Gap, under_a_rigid_motion_is_the_distance_of_the_rigidly_moved_point) {
  Random random;
  at_all_points([&](const Vector3d& phi, const Vector3d& a3) {
    for (const Face face : {Face::lower, Face::upper}) {
      const Gap g = gap_at(slope(), face, phi, a3, thickness);
      const Vector3d c = random.vector(), w = random.vector();
      const double moved = slope().distance(g.contact_point + c + w.cross(g.contact_point));
      EXPECT_NEAR(g(c + w.cross(phi), w.cross(a3)), moved, 1e-14);
    }
  });
}

}  // namespace
}  // namespace plastron::obstacle
