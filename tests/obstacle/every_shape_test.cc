// Each shape against points of its surface, which the test samples from the shape's parameters alone. The distance is that to the nearest
// sample, the gradient leads to a sample, and the sign is that of a direct test whether a point lies in the body.
#include <plastron/geometry/space_function.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "larger.hpp"
#include "obstacle/probing.hpp"

namespace plastron::obstacle::every_shape_test {
namespace {

using Points = std::vector<Vector3d>;
using Inside = std::function<bool(const Vector3d&)>;

constexpr double spacing = 0.04;  ///< no point of a surface is farther from a sample
constexpr double far = 3;         ///< half the width of the sampled part of unbounded surfaces
constexpr double reach = 1.2;     ///< probes lie in a cube of twice this side

struct Body {
  std::string name;
  Shape shape;
  Points surface{};  ///< samples of it
  Inside is_inside{};
};
void PrintTo(const Body& body, std::ostream* out) { *out << body.name; }

/// A frame with this third axis.
Matrix3d frame_of(const Vector3d& axis) {
  const Vector3d first = axis.unitOrthogonal();
  return (Matrix3d() << first, axis.cross(first), axis).finished();
}

/// Parameters from `from` to `to`, at most spacing / 2 apart, with both ends.
std::vector<double> steps(double from, double to, double speed = 1) {
  const int n = std::max(1, static_cast<int>(std::ceil(2 * speed * std::abs(to - from) / spacing)));
  std::vector<double> all;
  for (int i = 0; i <= n; ++i) all.push_back(from + (to - from) * i / n);
  return all;
}

/// Rotates points (rho, z) of a profile about the axis through `point`.
Points revolved_samples(const std::vector<Eigen::Vector2d>& profile, const Vector3d& point, const Vector3d& axis) {
  const Matrix3d frame = frame_of(axis);
  Points all;
  for (const Eigen::Vector2d& p : profile)
    for (const double angle : steps(0, 2 * std::numbers::pi, p[0]))
      all.push_back(point + frame * Vector3d(p[0] * std::cos(angle), p[0] * std::sin(angle), p[1]));
  return all;
}

void add_segment(std::vector<Eigen::Vector2d>& profile, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  for (const double t : steps(0, 1, (b - a).norm())) profile.push_back(a + t * (b - a));
}
/// Adds an arc between two angles from the rho axis towards the z axis.
void add_arc(std::vector<Eigen::Vector2d>& profile, const Eigen::Vector2d& centre, double radius, double from,
             double to) {
  for (const double angle : steps(from, to, radius))
    profile.push_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
}

/// (rho, z) of X for an axis.
Eigen::Vector2d profile_place(const Vector3d& X, const Vector3d& point, const Vector3d& axis) {
  const double z = (X - point).dot(axis);
  return {(X - point - z * axis).norm(), z};
}

const Vector3d at(0.1, -0.2, 0.15), tilted = Vector3d(1, -2, 2) / 3;

Body half_space() {
  Body body{"half-space", HalfSpace{at, tilted}};
  const Matrix3d frame = frame_of(tilted);
  for (const double a : steps(-far, far))
    for (const double b : steps(-far, far)) body.surface.push_back(at + frame * Vector3d(a, b, 0));
  body.is_inside = [](const Vector3d& X) { return (X - at).dot(tilted) < 0; };
  return body;
}

Body ball(bool inside) {
  constexpr double radius = 0.6;
  std::vector<Eigen::Vector2d> profile;
  add_arc(profile, {0, 0}, radius, -std::numbers::pi / 2, std::numbers::pi / 2);
  return {inside ? "bowl" : "ball", Ball{at, radius, inside}, revolved_samples(profile, at, tilted),
          [=](const Vector3d& X) { return ((X - at).norm() < radius) != inside; }};
}

Body torus() {
  std::vector<Eigen::Vector2d> profile;
  add_arc(profile, {0.7, 0}, 0.2, 0, 2 * std::numbers::pi);
  return {"torus", Torus{at, tilted, 0.7, 0.2}, revolved_samples(profile, at, tilted),
          [](const Vector3d& X) { return (profile_place(X, at, tilted) - Eigen::Vector2d(0.7, 0)).norm() < 0.2; }};
}

Body cylinder(const std::string& name, double half, double fillet, bool inside) {
  constexpr double radius = 0.5;
  Cylinder shape{.point = at, .axis = tilted, .radius = radius, .inside = inside, .fillet = fillet};
  if (half < far) shape.length = 2 * half;
  std::vector<Eigen::Vector2d> profile;
  add_segment(profile, {radius, fillet - half}, {radius, half - fillet});
  if (half < far) {
    for (const double side : {-1.0, 1.0}) {
      add_segment(profile, {0, side * half}, {radius - fillet, side * half});
      add_arc(profile, {radius - fillet, side * (half - fillet)}, fillet, 0, side * std::numbers::pi / 2);
    }
  }
  return {name, shape, revolved_samples(profile, at, tilted), [=](const Vector3d& X) {
            const Eigen::Vector2d p = profile_place(X, at, tilted), core(radius - fillet, half - fillet);
            const Eigen::Vector2d over = (Eigen::Vector2d(p[0], std::abs(p[1])) - core).cwiseMax(0);
            const bool is_in = fillet > 0 ? over.norm() < fillet : over.isZero(0);
            return is_in != inside;
          }};
}

Body cone(const std::string& name, double half_angle, double height, double fillet) {
  Cone shape{.apex = at, .axis = tilted, .half_angle = half_angle, .fillet = fillet};
  if (height < far) shape.height = height;
  const double s = std::sin(half_angle), tan = std::tan(half_angle);
  const Eigen::Vector2d out(std::cos(half_angle), -s), tip(0, fillet / s);
  const Eigen::Vector2d edge((height - fillet - tip[1]) * tan, height - fillet);
  std::vector<Eigen::Vector2d> profile;
  add_arc(profile, tip, fillet, -std::numbers::pi / 2, -half_angle);
  add_segment(profile, tip + fillet * out, edge + fillet * out);
  if (height < far) {
    add_arc(profile, edge, fillet, -half_angle, std::numbers::pi / 2);
    add_segment(profile, {0, height}, {edge[0], height});
  }
  return {name, shape, revolved_samples(profile, at, tilted), [=](const Vector3d& X) {
            const Eigen::Vector2d p = profile_place(X, at, tilted);
            // Corners of the sharp profile are cut off by the arcs.
            if (p.dot(out) > 0 || p[1] > height) return false;
            const Eigen::Vector2d along(-out[1], out[0]);
            if (along.dot(p - tip) < 0) return (p - tip).norm() < fillet;
            if (height < far && p[0] > edge[0] && along.dot(p - edge) > 0) return (p - edge).norm() < fillet;
            return true;
          }};
}

/// The rounded box is the projection of the sharp one's surface, and projections on convex bodies bring no points apart.
Body box(const std::string& name, double fillet) {
  const Vector3d size(1, 0.8, 0.5), core = size / 2 - Vector3d::Constant(fillet);
  const Matrix3d turned = Eigen::AngleAxisd(0.7, tilted).toRotationMatrix();
  Body body{name, Box{at, size, turned, fillet}};
  const auto nearest_of_core = [=](const Vector3d& p) { return Vector3d(p.cwiseMax(-core).cwiseMin(core)); };
  for (int face = 0; face < 3; ++face)
    for (const double side : {-1.0, 1.0})
      for (const double a : steps(-1, 1, size[(face + 1) % 3] / 2))
        for (const double b : steps(-1, 1, size[(face + 2) % 3] / 2)) {
          Vector3d p;
          p[face] = side * size[face] / 2;
          p[(face + 1) % 3] = a * size[(face + 1) % 3] / 2;
          p[(face + 2) % 3] = b * size[(face + 2) % 3] / 2;
          const Vector3d q = nearest_of_core(p);
          body.surface.push_back(at + turned * (fillet > 0 ? Vector3d(q + fillet * (p - q).normalized()) : p));
        }
  body.is_inside = [=](const Vector3d& X) {
    const Vector3d p = turned.transpose() * (X - at);
    const double off = (p - nearest_of_core(p)).norm();
    return fillet > 0 ? off < fillet : off == 0;
  };
  return body;
}

double wave(double x, double y) { return 0.2 * std::sin(6 * x) + 0.15 * x * y; }

Body graph() {
  Body body{"graph", HeightField(std::make_shared<const geometry::SpaceFunction>("0.2*sin(6*X) + 0.15*X*Y",
                                                                                 geometry::Constants{}))};
  for (const double x : steps(-far, far, 1.5))
    for (const double y : steps(-far, far, 1.5)) body.surface.emplace_back(x, y, wave(x, y));
  body.is_inside = [](const Vector3d& X) { return X[2] < wave(X[0], X[1]); };
  return body;
}

/// A raster of a quadratic function without second derivatives at its ends, which the natural spline reproduces: a plane with a twist.
Body raster() {
  const auto twist = [](double x, double y) { return 0.1 + 0.2 * x - 0.3 * y + 0.1 * x * y; };
  Eigen::MatrixXd heights(7, 7);
  for (Eigen::Index i = 0; i < 7; ++i)
    for (Eigen::Index j = 0; j < 7; ++j)
      heights(i, j) = twist(-far + static_cast<double>(i), -far + static_cast<double>(j));
  Body body{"raster", HeightField(std::make_shared<const Raster>(heights, Eigen::Vector2d(-far, -far), 1.0))};
  for (const double x : steps(-far, far, 1.5))
    for (const double y : steps(-far, far, 1.5)) body.surface.emplace_back(x, y, twist(x, y));
  body.is_inside = [=](const Vector3d& X) { return X[2] < twist(X[0], X[1]); };
  return body;
}

/// An ellipsoid as the zero set of a function that is no distance.
Body zero_set() {
  const Vector3d axes(0.9, 0.6, 0.5);
  const auto level = [=](const Vector3d& X) { return (X - at).cwiseQuotient(axes).squaredNorm() - 1; };
  Body body{"zero set", DistanceField(std::make_shared<const geometry::SpaceFunction>(
                            "((X-0.1)/0.9)^2 + ((Y+0.2)/0.6)^2 + ((Z-0.15)/0.5)^2 - 1", geometry::Constants{}))};
  for (const double v : steps(-std::numbers::pi / 2, std::numbers::pi / 2, axes[0]))
    for (const double u : steps(0, 2 * std::numbers::pi, axes[0]))
      body.surface.push_back(
          at + axes.cwiseProduct(Vector3d(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v))));
  body.is_inside = [=](const Vector3d& X) { return level(X) < 0; };
  return body;
}

TriangleMesh octahedron(double m) {
  TriangleMesh mesh;
  for (const double side : {-1.0, 1.0})
    for (int k = 0; k < 3; ++k) mesh.points.push_back(m * (at + side * (0.5 + 0.2 * k) * Vector3d::Unit(k)));
  for (int octant = 0; octant < 8; ++octant) {
    std::array<int, 3> corners{(octant & 1) * 3, (octant >> 1 & 1) * 3 + 1, (octant >> 2) * 3 + 2};
    const int downs = 3 - (octant & 1) - (octant >> 1 & 1) - (octant >> 2);
    if (downs % 2 == 1) std::swap(corners[1], corners[2]);
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

Body triangles() {
  Body body{"triangles", TriangleSurface(octahedron(1))};
  const TriangleMesh mesh = octahedron(1);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    for (const double s : steps(0, 1, (q - p).norm()))
      for (const double t : steps(0, 1, (r - p).norm()))
        if (s + t <= 1 + 1e-12) body.surface.push_back(p + s * (q - p) + t * (r - p));
    for (const double s : steps(0, 1, (r - q).norm())) body.surface.push_back(q + s * (r - q));
  }
  body.is_inside = [](const Vector3d& X) {
    return (X - at).cwiseAbs().cwiseQuotient(Vector3d(0.5, 0.7, 0.9)).sum() < 1;
  };
  return body;
}

std::vector<Body> bodies() {
  return {half_space(),
          ball(false),
          ball(true),
          torus(),
          cylinder("cylinder", far, 0, false),
          cylinder("tube", far, 0, true),
          cylinder("short cylinder", 0.6, 0, false),
          cylinder("rounded cylinder", 0.6, 0.2, false),
          cylinder("rounded can", 0.6, 0.2, true),
          box("box", 0),
          box("rounded box", 0.2),
          cone("cone", 0.5, far, 0),
          cone("short cone", 0.8, 0.9, 0),
          cone("rounded cone", 0.6, 0.9, 0.1),
          graph(),
          raster(),
          zero_set(),
          triangles()};
}

/// Random points in space, and others beside the surface.
Points probes_of(const Points& surface) {
  Points probes = test::random_points(60, reach);
  const Points ways = test::random_points(60, 0.1);
  for (std::size_t i = 0, next = 0; i < ways.size(); ++i) {
    next += 1 + surface.size() / (2 * ways.size());
    const Vector3d& p = surface[next % surface.size()];
    if (p.cwiseAbs().maxCoeff() < reach) probes.push_back(p + ways[i]);
  }
  return probes;
}

double distance_of(const Points& surface, const Vector3d& X) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : surface) least = std::min(least, (p - X).squaredNorm());
  return std::sqrt(least);
}

class EveryShape : public testing::TestWithParam<Body> {};
INSTANTIATE_TEST_SUITE_P(Each, EveryShape, testing::ValuesIn(bodies()), [](const auto& test) {
  std::string name = test.param.name;
  std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
  return name;
});

TEST_P(EveryShape, HasTheDistanceOfItsNearestPointAndTheGradientFromThere) {
  const auto& [name, shape, surface, is_inside] = GetParam();
  const Obstacle body{.shape = shape};
  int inside = 0, probes = 0;
  for (const Vector3d& X : probes_of(surface)) {
    const Nearest found = body.nearest(X);
    const double sampled = distance_of(surface, X), d = std::abs(found.distance);
    EXPECT_LE(d, sampled + 1e-9) << X.transpose();
    EXPECT_GE(d, sampled - spacing) << X.transpose();
    EXPECT_LE(distance_of(surface, X - found.distance * found.normal), spacing) << X.transpose();
    EXPECT_EQ(found.distance < 0, is_inside(X)) << X.transpose();
    inside += found.distance < 0 ? 1 : 0;
    ++probes;
  }
  EXPECT_GT(inside, 0);
  EXPECT_LT(inside, probes);
}

TEST_P(EveryShape, HasTheDifferencesOfItsDistanceAsGradientAndHessian) {
  test::expect_exact_derivatives(GetParam().shape, test::random_points(100, reach), 1, 3);
}

TEST_P(EveryShape, HasItsSurfaceAtDistanceZero) {
  const Obstacle body{.shape = GetParam().shape};
  const Points& surface = GetParam().surface;
  double off = 0;
  for (std::size_t i = 0; i < surface.size(); i += 1 + surface.size() / 200)
    if (surface[i].cwiseAbs().maxCoeff() < reach)
      off = plastron::test::larger(off, std::abs(body.nearest(surface[i]).distance));
  EXPECT_LT(off, 1e-9);
}

TEST_P(EveryShape, TurnsWithItsPlacement) {
  const Vector3d axis = Vector3d(2, -1, 2) / 3, about(0.3, 0.1, -0.2), shift(0.4, 0.5, -0.6);
  const Matrix3d R = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
  const Obstacle rest{.shape = GetParam().shape};
  Obstacle moved = rest;
  moved.placement = placed(axis, 1.1, about, shift);
  for (const Vector3d& x : test::random_points(40, reach)) {
    const Nearest there = moved.nearest(about + R * (x - about) + shift), here = rest.nearest(x);
    EXPECT_NEAR(there.distance, here.distance, 1e-9);
    EXPECT_LT((there.normal - R * here.normal).norm(), 1e-7);
    const double bend = 1 + std::pow(here.curvature.norm(), 2);
    EXPECT_LT((there.curvature - R * here.curvature * R.transpose()).norm(), 1e-6 * bend);
  }
}

// The analytic shapes in other units have a test of their own.
TEST(FunctionsAndTriangles, AreTheSameInMicrometresAndInMegametres) {
  const auto in_unit = [](double m) {
    const geometry::Constants unit{{"m", m}};
    Eigen::MatrixXd heights(5, 5);
    for (Eigen::Index i = 0; i < 5; ++i)
      for (Eigen::Index j = 0; j < 5; ++j)
        heights(i, j) = m * wave(-4 + 2 * static_cast<double>(i), -4 + 2 * static_cast<double>(j));
    return std::vector<Shape>{
        HeightField(std::make_shared<const geometry::SpaceFunction>("m*(0.2*sin(6*X/m) + 0.15*X/m*Y/m)", unit)),
        HeightField(std::make_shared<const Raster>(heights, Eigen::Vector2d(-4 * m, -4 * m), 2 * m)),
        DistanceField(std::make_shared<const geometry::SpaceFunction>(
            "((X/m-0.1)/0.9)^2 + ((Y/m+0.2)/0.6)^2 + ((Z/m-0.15)/0.5)^2 - 1", unit)),
        TriangleSurface(octahedron(m))};
  };
  const std::vector<Shape> in_metres = in_unit(1);
  for (const double m : {1e-6, 1e6}) {
    const std::vector<Shape> scaled = in_unit(m);
    for (std::size_t k = 0; k < scaled.size(); ++k)
      for (const Vector3d& X : test::random_points(40, reach)) {
        const Nearest one = Obstacle{.shape = in_metres[k]}.nearest(X),
                      other = Obstacle{.shape = scaled[k]}.nearest(m * X);
        EXPECT_NEAR(other.distance / m, one.distance, 1e-9) << k << ", unit " << m;
        EXPECT_LT((other.normal - one.normal).norm(), 1e-7) << k << ", unit " << m;
        EXPECT_LT((other.curvature * m - one.curvature).norm(), 1e-6 * (1 + std::pow(one.curvature.norm(), 2)))
            << k << ", unit " << m;
      }
  }
}

}  // namespace
}  // namespace plastron::obstacle::every_shape_test
