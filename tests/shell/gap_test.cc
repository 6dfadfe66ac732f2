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

/// A sharp edge of a body of the size `length`: a point of it, and the normals of the two faces that meet there.
struct SharpEdge {
  const char* name;
  Shape shape;
  Vector3d point, first, second;
};

TriangleSurface cube_of_triangles(double length) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) mesh.points.push_back(length * Vector3d(k % 2 - 0.5, k / 2 % 2 - 0.5, k / 4 - 0.5));
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return TriangleSurface(mesh, "cube");
}

std::vector<SharpEdge> sharp_edges(double length) {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ(), top = length / 2 * (x + z);
  return {{"box", Box{.size = length * Vector3d::Ones()}, top + 0.1 * length * Vector3d::UnitY(), z, x},
          {"cylinder", Cylinder{.radius = length / 2, .length = length}, top, z, x},
          {"cone", Cone{.height = length / 2}, top, z, (x - z).normalized()},
          {"triangles", cube_of_triangles(length), top + 0.1 * length * Vector3d::UnitY(), z, x}};
}

/// A node whose face is at X with the unit normal `inward`, and whose neighbours are at the distance `spacing`.
Gap gap_of_node(const Obstacle& body, const Vector3d& X, const Vector3d& inward, double spacing, bool is_upper) {
  Reach reach;
  reach.fill(spacing);
  const Vector3d a3 = is_upper ? Vector3d(-inward) : inward;
  return gap_at(body, {X + spacing * inward, a3, 2 * spacing}, reach);
}

// The face of a shell is smooth: on an edge it is pushed along its own normal, on whichever side of the edge the node is.
TEST(Edge, PushesASmoothFaceAlongTheNormalOfTheFace) {
  Random random;
  for (const double length : {1.0, 1e-6, 1e6})
    for (const SharpEdge& edge : sharp_edges(length))
      for (int draw = 0; draw < 20; ++draw) {
        SCOPED_TRACE(edge.name);
        Obstacle body{.shape = edge.shape};
        body.placement =
            placed(random.vector().normalized(), 3 * random.vector()[0], Vector3d::Zero(), length * random.vector());
        const auto turned = [&](const Vector3d& v) { return Vector3d(body.placement.rotation * v); };
        const double spacing = 0.05 * length, part = 0.5 + 0.45 * random.vector()[0];
        const Vector3d inward = ((1 - part) * edge.first + part * edge.second).normalized(),
                       along = edge.first.cross(edge.second).normalized().cross(inward);
        for (const double aside : {-0.5, -1e-9, 0.0, 1e-9, 0.3})
          for (const double height : {0.01, 0.0, -0.01}) {
            const Vector3d X = edge.point + spacing * (aside * along + height * inward);
            const Gap gap = gap_of_node(body, body.placement.to_space(X), turned(inward), spacing, draw % 2 == 0);
            EXPECT_LT((gap.normal - turned(inward)).norm(), 1e-6) << aside << " " << height;
            EXPECT_NEAR(gap.initial, height * spacing, 1e-6 * spacing) << aside;
          }
      }
}

TEST(Edge, PushesAFaceThatLiesOnASideAlongTheNormalOfTheSide) {
  for (const SharpEdge& edge : sharp_edges(1))
    for (const double tilt : {0.0, 0.1})
      for (const double aside : {-0.3, -1e-12, 0.0, 1e-12, 0.3}) {
        const Vector3d out = edge.second - edge.first.dot(edge.second) * edge.first,
                       inward = (edge.first - tilt * out.normalized()).normalized();
        const Gap gap = gap_of_node({.shape = edge.shape}, edge.point + 0.05 * aside * out, inward, 0.05, false);
        EXPECT_LT((gap.normal - edge.first).norm(), 1e-9) << edge.name << aside;
        EXPECT_NEAR(gap.initial, 0, 1e-11) << edge.name << aside;
      }
}

// Beyond the end of a shell there is no face, and an edge there pushes nothing.
TEST(Edge, BeyondTheLastNodeOfTheShellIsNotTouched) {
  const Vector3d inward = Vector3d(0.1, 0, 1).normalized(), out(1, 0, -0.1);
  for (const bool ends : {false, true}) {
    Reach reach;
    reach.fill(0.05);
    if (ends) reach[reach_direction(inward, out)] = 0;
    const Gap gap = gap_at({.shape = Box{}}, {Vector3d(0.49, 0, 0.5) + 0.05 * inward, inward, 0.1}, reach);
    EXPECT_LT((gap.normal - (ends ? Vector3d::UnitZ() : inward)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace plastron::obstacle
