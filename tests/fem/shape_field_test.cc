// Shapes of modes as changes of the mid-surface: values and derivatives on another mesh, and frames of the changed surface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/shape_field.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/mesh/basis.hpp>

#include <cmath>
#include <memory>

namespace plastron::fem {
namespace {

using geometry::Vector3d;
using testing::HasSubstr;
using Vector6 = ShapeField::Vector6;

/// A polynomial of second degree.
Vector6 value_at(const Vector2d& x) {
  Vector6 v;
  v << x[0] * x[1], 1 - x[1] * x[1], x[0] * x[0], 0.1 * x[0], -0.1 * x[1], 0.05 * x[0] * x[1];
  return v;
}

/// The field on the cells of a domain, each divided in four.
std::shared_ptr<const ShapeField> field_on(const mesh::CoarseMesh& coarse, int degree, double factor = 1) {
  ShapeField::Cells cells{.shape = coarse.shape, .degree = degree};
  for (const mesh::CoarseCell& cell : coarse.cells)
    for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(0.5, 0), Vector2d(0, 0.5), Vector2d(0.5, 0.5)})
      for (const Vector2d& xi : mesh::node_points(coarse.shape, degree)) {
        cells.points.push_back(cell.map(corner + xi / 2).value);
        cells.values.push_back(factor * value_at(cells.points.back()));
      }
  return std::make_shared<const ShapeField>(std::move(cells));
}

mesh::CoarseMesh disk() { return domain::coarse_mesh(domain::Disk{.radius = 1}, mesh::Shape::quadrilateral); }

TEST(ShapeField, InterpolatesOnCurvedCells) {
  double error_before = 0;
  for (const int degree : {3, 6}) {
    const auto field = field_on(disk(), degree);
    double error = 0;
    for (double radius = 0; radius <= 1; radius += 0.05)
      for (double angle = 0; angle < 6; angle += 0.3) {
        const Vector2d x = radius * Vector2d(std::cos(angle), std::sin(angle));
        const auto jet = field->at(x, x);
        const Vector6 exact = value_at(x);
        error = std::max({error, (jet.u - exact.head<3>()).norm(), (jet.r - exact.tail<3>()).norm(),
                          (jet.du[0] - Vector3d(x[1], 0, 2 * x[0])).norm(),
                          (jet.du[1] - Vector3d(x[0], -2 * x[1], 0)).norm(),
                          (jet.dr[0] - Vector3d(0.1, 0, 0.05 * x[1])).norm()});
      }
    EXPECT_LT(error, degree == 3 ? 5e-2 : 5e-4);
    if (degree == 6) {
      EXPECT_LT(error, error_before / 20);
    }
    error_before = error;
  }
}

TEST(ShapeField, TakesDerivativesOnTheSideThatIsAskedFor) {
  const mesh::CoarseMesh coarse =
      domain::coarse_mesh(domain::Rectangle{.to = {2, 1}, .cells = {2, 1}}, mesh::Shape::quadrilateral);
  ShapeField::Cells cells{.degree = 1};
  for (const mesh::CoarseCell& cell : coarse.cells)
    for (const Vector2d& xi : mesh::node_points(coarse.shape, 1)) {
      cells.points.push_back(cell.map(xi).value);
      cells.values.emplace_back(Vector6::Constant(std::abs(cells.points.back()[0] - 1)));
    }
  const ShapeField field(std::move(cells));
  EXPECT_NEAR(field.at({1, 0.5}, {0.9, 0.5}).du[0][0], -1, 1e-12);
  EXPECT_NEAR(field.at({1, 0.5}, {1.1, 0.5}).du[0][0], 1, 1e-12);
}

// On a mesh in space points are addresses: 2 c + xi_1 in the cell c.
TEST(ShapeField, FindsPointsOfThinCellsFarFromTheOrigin) {
  ShapeField::Cells cells{.degree = 1};
  for (const double from : {4000.0, 4000.001})
    for (const Vector2d& xi : mesh::node_points(mesh::Shape::quadrilateral, 1)) {
      cells.points.emplace_back(from + 0.001 * xi[0], xi[1]);
      cells.values.emplace_back(Vector6::Constant(cells.points.back()[0] - 4000));
    }
  const ShapeField field(std::move(cells));
  for (const double x : {0.0001, 0.0009, 0.0015}) EXPECT_NEAR(field.at({4000 + x, 0.3}, {4000 + x, 0.3}).u[0], x, 1e-9);
}

TEST(ShapeField, RefusesPointsOfAnotherDomain) {
  const auto field = field_on(disk(), 2);
  try {
    static_cast<void>(field->at({2, 0}, {2, 0}));
    FAIL();
  } catch (const mesh::DomainError& error) {
    EXPECT_THAT(error.what(), HasSubstr("x = 2, y = 0"));
  }
}

// The frames of phi + u, with derivatives in the cell's own coordinates.
TEST(ShapeField, ChangesTheFramesOfASurface) {
  auto coarse = std::make_shared<mesh::CoarseMesh>(disk());
  const std::map<std::string, geometry::Chart> charts{{"", geometry::Chart({"x", "y", "x*y/4"}, {})}};
  const Surface before(coarse, charts);
  auto changed = std::make_shared<mesh::CoarseMesh>(*coarse);
  changed->shifts = {field_on(*coarse, 6, 0.01), field_on(*coarse, 6, 0.02)};
  const Surface after(changed, charts);
  const Cell cell{.coarse = 2, .corner = {0.25, 0.5}, .size = 0.5};
  const Vector2d xi(0.3, 0.4);
  Vector2d x;
  before.positions(cell, {&xi, 1}, {&x[0], 1}, {&x[1], 1});
  const geometry::Frame frame = after.frame(cell, xi);
  EXPECT_LT((frame.phi - before.frame(cell, xi).phi - 0.03 * value_at(x).head<3>()).norm(), 1e-6);
  EXPECT_LT((frame.a3 - (before.frame(cell, xi).a3 + 0.03 * value_at(x).tail<3>()).normalized()).norm(), 1e-6);
  EXPECT_NEAR(frame.a3.norm(), 1, 1e-14);
  const double h = 1e-5;
  for (int a = 0; a < 2; ++a) {
    const Vector2d step = h * Vector2d::Unit(a);
    const geometry::Frame ahead = after.frame(cell, xi + step), behind = after.frame(cell, xi - step);
    const auto k = static_cast<std::size_t>(a);
    EXPECT_LT((frame.a_cov[k] - (ahead.phi - behind.phi) / (2 * h)).norm(), 1e-8);
    EXPECT_LT((frame.da3[k] - (ahead.a3 - behind.a3) / (2 * h)).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace plastron::fem
