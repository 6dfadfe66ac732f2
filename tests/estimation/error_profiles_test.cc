// The direction of a cell that an error is assigned to, and its place there.
#include "assembly/sample_shells.hpp"

#include <plastron/domain/domain_mesh.hpp>
#include <plastron/estimation/strain_errors.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <numeric>

namespace plastron::estimation {
namespace {

/// The profile of an error on a flat square cell that a single bending strain makes.
ErrorProfile profile_of(const std::function<double(const Eigen::Vector2d&)>& strain) {
  const fem::MeshSequence meshes(domain::coarse_mesh(domain::Rectangle{.cells = {1, 1}}, mesh::Shape::quadrilateral), 4,
                                 MPI_COMM_SELF);
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart(test::flat, {}));
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, charts);
  const auto discrete =
      assembly::discretise(meshes.space(), surface, {.sections = test::steel_of(geometry::Expression(0.1))});
  const std::vector<Eigen::Vector2d>& xi = discrete->shell.tables().quadrature.xi;
  StrainErrors errors{.error = energy::CellStrain::Zero(static_cast<Eigen::Index>(xi.size()), 8),
                      .stresses = {},
                      .incompatibility = {}};
  for (std::size_t q = 0; q < xi.size(); ++q) errors.error(static_cast<Eigen::Index>(q), 3) = strain(xi[q]);
  return error_profiles(discrete->shell, {errors}).front();
}

double sum(const std::vector<double>& slices) { return std::accumulate(slices.begin(), slices.end(), 0.0); }

TEST(ErrorProfiles, GiveWhatChangesAlongOneDirectionToThatOne) {
  const ErrorProfile first = profile_of([](const Eigen::Vector2d& xi) { return 2 * xi[0] - 1; });
  EXPECT_NEAR(sum(first[0]), 1, 1e-12);
  EXPECT_NEAR(sum(first[1]), 0, 1e-12);
  const ErrorProfile second = profile_of([](const Eigen::Vector2d& xi) { return 2 * xi[1] - 1; });
  EXPECT_NEAR(sum(second[0]), 0, 1e-12);
  EXPECT_NEAR(sum(second[1]), 1, 1e-12);
}

/// Four fifths of P_2(xi_1) P_1(xi_2) vary along xi_1. A constant has no direction, and a zero error has no profile.
TEST(ErrorProfiles, ShareWhatChangesAlongBoth) {
  const ErrorProfile both = profile_of([](const Eigen::Vector2d& xi) {
    const double x = 2 * xi[0] - 1, y = 2 * xi[1] - 1;
    return (3 * x * x - 1) * y;
  });
  EXPECT_NEAR(sum(both[0]), 0.8, 1e-12);
  EXPECT_NEAR(sum(both[1]), 0.2, 1e-12);
  const ErrorProfile constant = profile_of([](const Eigen::Vector2d&) { return 1.0; });
  EXPECT_NEAR(sum(constant[0]), 0.5, 1e-12);
  EXPECT_NEAR(sum(constant[1]), 0.5, 1e-12);
  const ErrorProfile none = profile_of([](const Eigen::Vector2d&) { return 0.0; });
  EXPECT_EQ(sum(none[0]) + sum(none[1]), 0);
}

TEST(ErrorProfiles, SayAtWhichSideItIs) {
  const ErrorProfile late = profile_of([](const Eigen::Vector2d& xi) { return xi[0] * xi[0] * xi[0]; });
  ASSERT_EQ(late[0].size(), 5U);
  for (std::size_t i = 0; i + 1 < 5; ++i) EXPECT_LT(late[0][i], late[0][i + 1] + 1e-12);
  EXPECT_GT(late[0][3] + late[0][4], 0.9 * sum(late[0]));
}

}  // namespace
}  // namespace plastron::estimation
