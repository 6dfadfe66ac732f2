// Named curves inside a mesh, and curves in several groups. Supports and loads act on each once, on any number of
// ranks, on both shapes and on every level.
#include "assembly/sample_shells.hpp"
#include "supported.hpp"

#include <plastron/domain/domain.hpp>
#include <plastron/energy/load_vector.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace plastron::assembly::inner_curves_test {
namespace {

using std::numbers::pi;

struct Case {
  std::string file;
  mesh::Shape shape;
};

/// The quarter annulus 1 < |x| < 2. "rim" is its whole boundary, "south" the part with y = 0, "mid" the inner
/// arc |x| = 1.5, drawn from (1.5, 0) to (0, 1.5).
const std::vector<Case> arcs{{"arcs-of-order-4-4.1.msh", test::quadrilateral},
                             {"arcs-of-order-4-2.2.msh", test::quadrilateral},
                             {"arcs-of-order-4-4.1.msh", test::triangle},
                             {"arc-triangles-of-order-4-4.1.msh", test::triangle}};

void for_every_mesh(const std::function<void(const test::MeshedSurface&)>& check) {
  for (const auto& [file, shape] : arcs)
    for (int refinements = 0; refinements < 3; ++refinements) {
      SCOPED_TRACE(file + (shape == test::triangle ? ", triangles, " : ", ") + std::to_string(refinements) +
                   " refinements");
      const domain::MeshFile mesh{std::string(PLASTRON_TESTS_DIR "/domain/data/") + file};
      check(test::meshed(mesh, {"x", "y", "0.3"}, 2, refinements, shape));
    }
}

std::unique_ptr<DiscreteShell> shell_held_by(const test::MeshedSurface& m, const std::vector<Support>& supports) {
  return discretise(m.space, m.surface, {.sections = test::steel_of(geometry::Expression(0.1)), .supports = supports});
}

Eigen::Matrix<double, 6, 1> total(const algebra::Vector& f) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < f.owned().size(); ++i) sum[static_cast<Eigen::Index>(i % 6)] += f.owned()[i];
  for (double& component : sum) component = algebra::sum_over_ranks(component, MPI_COMM_WORLD);
  return sum;
}

Eigen::Matrix<double, 6, 1> total_of_load_on(const test::MeshedSurface& m, const std::string& boundary) {
  energy::EdgeLoad load{.boundary = boundary};
  load.force = {geometry::Expression("x^2 + y^2", {}), geometry::Expression(7.0), geometry::Expression(-2.0)};
  load.couple[1] = geometry::Expression(3.0);
  const energy::ShellOperator shell(m.space, m.surface, test::steel_of(geometry::Expression(0.1)), true, false);
  return total(load_vector(shell, {.on_edges = {load}}));
}

TEST(InnerCurve, CarriesALineLoadAndACoupleOnce) {
  for_every_mesh([](const test::MeshedSurface& m) {
    const auto sum = total_of_load_on(m, "mid");
    const double length = 0.75 * pi;
    EXPECT_NEAR(sum[0], 2.25 * length, 1e-4);
    EXPECT_NEAR(sum[1], 7 * length, 1e-4);
    EXPECT_NEAR(sum[2], -2 * length, 1e-4);
    EXPECT_NEAR(sum[4], 3 * length, 1e-4);
  });
}

TEST(OverlappingCurves, CarryTheirLoadsEach) {
  for_every_mesh([](const test::MeshedSurface& m) {
    EXPECT_NEAR(total_of_load_on(m, "south")[1], 7 * 1, 1e-10);
    EXPECT_NEAR(total_of_load_on(m, "rim")[1], 7 * (1.5 * pi + 2), 1e-4);
  });
}

/// The owned nodes at which a support of u.z acts lie on the curve, and all nodes on the curve are fixed.
void expect_held(const test::MeshedSurface& m, const std::string& boundary,
                 const std::function<double(const Eigen::Vector2d&)>& distance) {
  const Support support{.boundary = boundary,
                        .components = {{Unknown::displacement, Direction::z, geometry::Expression(0.25)}}};
  const auto discrete = shell_held_by(m, {support});
  double held = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.space->layout->owned); ++i) {
    const bool is_near = distance(discrete->points[i].x) < 1e-2;
    EXPECT_EQ(test::is_supported(discrete->coordinates, i), is_near)
        << boundary << " " << discrete->points[i].x.transpose();
    held += is_near;
  }
  EXPECT_GE(algebra::sum_over_ranks(held, MPI_COMM_WORLD), 3) << boundary;
}

TEST(InnerCurve, HoldsItsNodesAndNoOthers) {
  for_every_mesh([](const test::MeshedSurface& m) {
    expect_held(m, "mid", [](const Eigen::Vector2d& x) { return std::abs(x.norm() - 1.5); });
  });
}

TEST(OverlappingCurves, HoldTheirNodesEach) {
  for_every_mesh([](const test::MeshedSurface& m) {
    expect_held(m, "south", [](const Eigen::Vector2d& x) { return x[1]; });
    expect_held(m, "rim", [](const Eigen::Vector2d& x) {
      return std::min({x[0], x[1], std::abs(x.norm() - 1), std::abs(x.norm() - 2)});
    });
  });
}

// "mid" is drawn with the centre on its left, so its conormal points away from the centre.
TEST(InnerCurve, HasItsConormalOnTheRightOfItsDirection) {
  for_every_mesh([](const test::MeshedSurface& m) {
    const Support support{.boundary = "mid",
                          .components = {{Unknown::displacement, Direction::conormal, geometry::Expression(1e-3)}}};
    const auto discrete = shell_held_by(m, {support});
    const auto all = node_supports(*m.space, *m.surface, discrete->points, {support});
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].displacement.empty()) continue;
      ASSERT_EQ(all[i].displacement.size(), 1u);
      const Eigen::Vector2d radial = discrete->points[i].x.normalized();
      EXPECT_NEAR((all[i].displacement[0].first - Vector3d(radial[0], radial[1], 0)).norm(), 0, 1e-2);
    }
  });
}

TEST(EdgeLoads, OnABoundaryThatIsNotThereAreRefused) {
  const auto m = test::meshed(domain::Disk{}, test::flat, 2, 0);
  EXPECT_THROW(total_of_load_on(m, "no such"), energy::LoadError);
}

}  // namespace
}  // namespace plastron::assembly::inner_curves_test
