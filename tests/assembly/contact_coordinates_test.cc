// Bases of nodes at contact: gaps that the rotation does not change, that hardly differ, and that depend on others.
#include <plastron/assembly/contact_coordinates.hpp>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <algorithm>
#include <numeric>

namespace plastron::assembly {
namespace {

using obstacle::Gap;

constexpr double half = 0.05;
const std::vector<Vector3d> everywhere{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};

std::vector<Vector3d> tangents(const Vector3d& a3) {
  const auto pair = across(a3.normalized());
  return {pair[0], pair[1]};
}

Gap gap(const Vector3d& normal, double z, double initial = 0) {
  return {.initial = initial, .normal = normal.normalized(), .z = z, .contact_point = Vector3d::Zero()};
}

Gap of_another_side(const Vector3d& normal, double z) {
  Gap moved = gap(normal, z);
  moved.arm = 0;
  return moved;
}

ContactCoordinates coordinates(const std::vector<Gap>& gaps, const std::vector<Vector3d>& u,
                               const std::vector<Vector3d>& r) {
  std::vector<std::size_t> nearest_first(gaps.size());
  std::iota(nearest_first.begin(), nearest_first.end(), std::size_t{0});
  std::ranges::stable_sort(nearest_first, {}, [&](std::size_t k) { return gaps[k].initial; });
  return contact_coordinates(gaps, nearest_first, u, r);
}

/// The largest part of a column: u, or r times half of the thickness.
double largest(const ContactCoordinates& found) {
  double most = 0;
  for (const ContactColumn& column : found.columns)
    most = std::max({most, column.u.cwiseAbs().maxCoeff(), half * column.r.cwiseAbs().maxCoeff()});
  return most;
}

std::vector<bool> left_out(const ContactCoordinates& found) {
  std::vector<bool> marks;
  for (const ContactPlace& place : found.places) marks.push_back(place.is_left_out);
  return marks;
}

/// Each column changes the gap by the scale of its place, or not at all.
void expect_coordinates(const std::vector<Gap>& gaps, const ContactCoordinates& found) {
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const ContactPlace& place = found.places[i];
    if (place.is_left_out) continue;
    for (std::size_t k = 0; k < found.columns.size(); ++k) {
      const double change = gaps[i].normal.dot(found.columns[k].u + gaps[i].arm * found.columns[k].r);
      EXPECT_NEAR(change, static_cast<int>(k) == place.coordinate ? place.scale : 0, 1e-10) << i << " " << k;
    }
  }
}

TEST(ContactCoordinates, OfAFaceThatTheRotationDoesNotMoveAreDisplacements) {
  const std::vector<Vector3d> r = tangents({1, 0, 0});
  const Gap below = of_another_side({0, 0.1, 1}, -half), above = of_another_side({0, 0.1, 1}, half);
  for (const std::vector<Gap>& gaps : {std::vector{below}, {below, above}, {below, gap({0, 0, 1}, half)}}) {
    const ContactCoordinates found = coordinates(gaps, everywhere, r);
    ASSERT_EQ(found.columns.size(), 5U);
    EXPECT_LT(largest(found), 11);
    EXPECT_EQ(found.places[0].coordinate, 0);
    expect_coordinates(gaps, found);
  }
}

TEST(ContactCoordinates, OfAFaceThatTheRotationDoesNotMoveHaveNoBoundWhereUIsFixed) {
  const std::vector<Vector3d> r = tangents({1, 0, 0});
  const Gap below = of_another_side({0, 0, 1}, -half), above = of_another_side({0, 0, 1}, half);
  for (const std::vector<Gap>& gaps : {std::vector{below}, {below, above}}) {
    const ContactCoordinates found = coordinates(gaps, {}, r);
    ASSERT_EQ(found.columns.size(), 2U);
    EXPECT_LE(largest(found), half);
    for (const ContactPlace& place : found.places) EXPECT_EQ(place.coordinate, -1);
  }
}

// The normal of a mesh has some digits only. The far face is a thickness behind and needs no bound.
TEST(ContactCoordinates, LeaveOutTheFarFaceOnTheSameSide) {
  for (const double slope : {2e-6, 1e-4, 1e-2}) {
    const std::vector<Gap> gaps{gap({0, 0, 1}, half, 2 * half), gap({0, 0, 1}, -half)};
    const ContactCoordinates found = coordinates(gaps, everywhere, tangents({slope, 0, 1}));
    EXPECT_EQ(left_out(found), (std::vector{true, false})) << slope;
    EXPECT_LT(largest(found), 2) << slope;
    expect_coordinates(gaps, found);
  }
}

// The two gaps differ by a rotation times the slope. A shell of finite thickness cannot touch both plates unless it is squeezed.
TEST(ContactCoordinates, BoundTheFarFaceOfAShellBetweenPlatesByTheCoordinateOfTheNearOne) {
  for (const double slope : {2e-6, 1e-4, 1e-2, 0.05})
    for (const bool ceiling_first : {false, true}) {
      std::vector<Gap> gaps{gap({0, 0, 1}, -half, 0.1), gap({0, 0, -1}, half, 0.2)};
      if (ceiling_first) std::swap(gaps[0], gaps[1]);
      const std::size_t near = ceiling_first ? 1 : 0, far = 1 - near;
      const ContactCoordinates found = coordinates(gaps, everywhere, tangents({slope, 0, 1}));
      EXPECT_LT(largest(found), 2) << slope;
      EXPECT_FALSE(found.places[near].is_approximate);
      EXPECT_TRUE(found.places[far].is_approximate);
      EXPECT_EQ(found.places[far].coordinate, found.places[near].coordinate);
      EXPECT_NEAR(found.places[far].scale, -1, slope);
    }
}

TEST(ContactCoordinates, SeparateTheFacesWhereTheRotationMovesThem) {
  const std::vector<Gap> gaps{gap({0, 0, 1}, -half), gap({0, 0, -1}, half)};
  const ContactCoordinates found = coordinates(gaps, everywhere, tangents({1, 0, 2}));
  EXPECT_EQ(left_out(found), (std::vector{false, false}));
  EXPECT_FALSE(found.places[0].is_approximate || found.places[1].is_approximate);
  expect_coordinates(gaps, found);
}

// Two rollers along y meet both faces. All gaps change with u_x, u_z and one rotation, but for the small slope along y.
TEST(ContactCoordinates, LeaveOutAGapThatNearlyDependsOnNearerOnes) {
  for (const double slope : {0.0, 2e-6, 1e-4}) {
    const std::vector<Gap> gaps{gap({0.95, 0, 0.31}, -half, 0.5), gap({0.94, 0, 0.34}, half, 0.55),
                                gap({0.4, 0, 0.9}, -half), gap({0.35, 0, 0.93}, half, 2 * half)};
    const ContactCoordinates found = coordinates(gaps, everywhere, tangents({0, slope, 1}));
    EXPECT_EQ(left_out(found), (std::vector{false, true, false, false})) << slope;
    EXPECT_LT(largest(found), 20) << slope;
    expect_coordinates(gaps, found);
  }
}

}  // namespace
}  // namespace plastron::assembly
