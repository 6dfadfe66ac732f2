#include "assembly/sample_shells.hpp"

#include <plastron/geometry/frame.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace plastron::assembly {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

RigidObstacles table() {
  return {
      .all = {{.shape = obstacle::HalfSpace{.point = {0, 0, -0.2}, .normal = Vector3d(0.2, -0.1, 1).normalized()}}}};
}

struct Sample {
  test::MeshedSurface m;
  std::unique_ptr<DiscreteShell> discrete;
};

Sample sample(const std::vector<Support>& supports, const RigidObstacles& obstacles) {
  auto m = test::meshed(test::skew(), test::saddle, 3, 1);
  auto discrete = discretise(m.space, m.surface,
                             {.sections = test::steel_of(geometry::Expression("0.1 + 0.02*x", {})),
                              .supports = supports,
                              .obstacles = obstacles});
  return {std::move(m), std::move(discrete)};
}

Support fix(const std::string& boundary, std::vector<PrescribedComponent> components) {
  return {.boundary = boundary, .components = std::move(components)};
}

std::vector<Support> assorted_supports() {
  const geometry::Expression zero, value("0.01*x*y - 0.02*y", {});
  return {test::clamp("edge1"),
          fix("edge2",
              {{Unknown::displacement, Direction::conormal, zero}, {Unknown::rotation, Direction::conormal, zero}}),
          fix("edge3", {{Unknown::displacement, Direction::z, value}, {Unknown::rotation, Direction::tangent, zero}}),
          fix("edge4", {{Unknown::displacement, Direction::x, zero},
                        {Unknown::displacement, Direction::y, zero},
                        {Unknown::displacement, Direction::z, value}})};
}

// (M12): five unknowns a node, r tangent.
TEST(NodalCoordinates, EveryBasisSpansTheTangentFormulation) {
  for (const auto& supports : {std::vector<Support>{}, assorted_supports()})
    for (const auto& obstacles : {RigidObstacles{}, table()}) {
      const Sample s = sample(supports, obstacles);
      for (std::size_t i = 0; i < s.discrete->points.size(); ++i) {
        const NodeBasis& T = s.discrete->coordinates.basis[i];
        EXPECT_EQ(T.fullPivLu().rank(), 6);
        for (int k = 0; k < 5; ++k) EXPECT_NEAR(T.col(k).tail<3>().dot(s.discrete->points[i].a3), 0, 1e-13);
      }
    }
}

TEST(NodalCoordinates, TheFirstCoordinateIsTheChangeOfTheGapAndNoOtherFreeOneChangesIt) {
  for (const auto& supports : {std::vector<Support>{}, assorted_supports()}) {
    const Sample s = sample(supports, table());
    const auto& c = s.discrete->coordinates;
    int touchable = 0;
    for (std::size_t i = 0; i < s.discrete->points.size(); ++i) {
      if (!c.is_touchable(i)) continue;
      ++touchable;
      Vector6 row;
      row << c.gaps[0][i].normal, c.gaps[0][i].z * c.gaps[0][i].normal;
      EXPECT_NEAR(row.dot(c.basis[i].col(0)), 1, 1e-12);
      EXPECT_EQ(c.lower.local()[5 * i], -c.rows[i].bound_gap);
      for (std::size_t k = 1; k < 5; ++k)
        if (c.lower.local()[5 * i + k] != c.upper.local()[5 * i + k]) {
          EXPECT_NEAR(row.dot(c.basis[i].col(static_cast<Eigen::Index>(k))), 0, 1e-12);
        }
    }
    EXPECT_GT(touchable, 10);
  }
}

// The relaxed formulations (M13, M14): r . a_3 is a coordinate of its own. It does not change the gap, which contains
// only the tangential part of r. Any prescribed rotation prescribes it too.
TEST(NodalCoordinates, RelaxedFormulationsAddTheNormalRotation) {
  auto m = test::meshed(test::skew(), test::saddle, 3, 1);
  for (const auto formulation : {element::Formulation::penalised, element::Formulation::mixed}) {
    const auto discrete = discretise(m.space, m.surface,
                                     {.sections = test::steel_of(geometry::Expression(0.1)),
                                      .tangency = {.formulation = formulation},
                                      .supports = assorted_supports(),
                                      .obstacles = table()});
    const auto& c = discrete->coordinates;
    EXPECT_EQ(c.width, 6);
    const auto rows = node_supports(*m.space, *m.surface, discrete->points, assorted_supports());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(c.basis[i].col(5).head<3>().norm(), 0);
      EXPECT_NEAR((c.basis[i].col(5).tail<3>() - discrete->points[i].a3).norm(), 0, 1e-15);
      EXPECT_EQ(c.is_prescribed(i, 5), !rows[i].rotation.empty());
    }
  }
}

// At the bound z_0 = lower, and with the prescribed values, the gap is zero.
TEST(NodalCoordinates, AtTheBoundTheGapIsZero) {
  const Sample s = sample(assorted_supports(), table());
  const auto& c = s.discrete->coordinates;
  for (std::size_t i = 0; i < s.discrete->points.size(); ++i) {
    if (!c.is_touchable(i)) continue;
    Eigen::Matrix<double, 5, 1> z;
    for (std::size_t k = 0; k < 5; ++k)
      z[static_cast<Eigen::Index>(k)] = std::isfinite(c.lower.local()[5 * i + k]) ? c.lower.local()[5 * i + k] : 0.3;
    const Vector6 y = c.basis[i].leftCols<5>() * z;
    EXPECT_NEAR(c.gaps[0][i](y.head<3>(), y.tail<3>()), 0, 1e-13);
  }
}

TEST(NodalCoordinates, PrescribedComponentsHaveTheirValues) {
  const Sample s = sample(assorted_supports(), table());
  const auto& c = s.discrete->coordinates;
  const auto rows = node_supports(*s.m.space, *s.m.surface, s.discrete->points, assorted_supports());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Eigen::Matrix<double, 5, 1> z;
    for (std::size_t k = 0; k < 5; ++k)
      z[static_cast<Eigen::Index>(k)] = std::isfinite(c.lower.local()[5 * i + k]) ? c.lower.local()[5 * i + k] : 0.7;
    if (c.is_touchable(i)) z[0] = 0.4;
    const Vector6 y = c.basis[i].leftCols<5>() * z;
    for (const auto& [d, value] : rows[i].displacement) EXPECT_NEAR(d.dot(y.head<3>()), value, 1e-12);
    for (const auto& [d, value] : rows[i].rotation) EXPECT_NEAR(d.dot(y.tail<3>()), value, 1e-12);
  }
}

TEST(NodalCoordinates, ContradictingValuesAreRefusedWithTheirPlace) {
  const geometry::Expression one(1.0), nearly_one(1 + 2e-7);
  try {
    sample({fix("edge1", {{Unknown::displacement, Direction::z, one}}),
            fix("edge2", {{Unknown::displacement, Direction::z, nearly_one}})},
           {});
    FAIL() << "not refused";
  } catch (const SupportError& error) {
    EXPECT_NE(std::string(error.what()).find("x = 1, y = 0.1"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("differs by 2e-07"), std::string::npos) << error.what();
  }
}

TEST(NodalCoordinates, AnUnknownBoundaryIsRefusedWithTheKnownOnes) {
  try {
    sample({fix("rim", {{Unknown::displacement, Direction::z, geometry::Expression()}})}, {});
    FAIL() << "not refused";
  } catch (const SupportError& error) {
    EXPECT_NE(std::string(error.what()).find("edge1, edge2, edge3, edge4"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace plastron::assembly
