// Faces and curves of surfaces of triangles, and what is refused or mended.
#include "facets/surfaces.hpp"

#include <plastron/geometry/file_error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace plastron::facets {
namespace {

using namespace surfaces;  // NOLINT: builders of surfaces
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double smooth = pi / 6;

Facets found(TriangleMesh mesh) { return find_facets(std::move(mesh), smooth, "part.stl"); }

std::string refusal(TriangleMesh mesh) {
  try {
    found(std::move(mesh));
  } catch (const geometry::FileError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

std::size_t count(const Facets& facets, CurveKind kind) {
  return static_cast<std::size_t>(std::ranges::count(facets.curves, kind, &FacetCurve::kind));
}

TEST(Facets, OfACubeAreSixFacesWithTwelveFolds) {
  const Facets facets = found(cube());
  EXPECT_THAT(facets.faces, ElementsAre("surface 1", "surface 2", "surface 3", "surface 4", "surface 5", "surface 6"));
  EXPECT_EQ(facets.curves.size(), 12U);
  EXPECT_EQ(count(facets, CurveKind::fold), 12U);
  EXPECT_EQ(facets.curves.back().name, "edge 12");
  EXPECT_EQ(facets.corners.size(), 8U);
  EXPECT_NEAR(facets.least_fold, pi / 2, 1e-12);
  EXPECT_NEAR(area_of(facets.mesh), 6, 1e-12);
}

TEST(Facets, OfASmoothSurfaceAreOneFaceBetweenItsBorders) {
  const Facets tube_facets = found(tube(36));
  EXPECT_EQ(tube_facets.faces.size(), 1U);
  ASSERT_EQ(count(tube_facets, CurveKind::border), 2U);
  EXPECT_EQ(tube_facets.curves.size(), 2U);
  EXPECT_EQ(tube_facets.curves[0].sides.size(), 36U);
  EXPECT_NEAR(tube_facets.largest_smooth, pi / 18, 1e-8);
  EXPECT_NEAR(tube_facets.mean_smooth, pi / 18, 1e-8);
  EXPECT_NEAR(tube_facets.width, 2 * std::sin(pi / 36), 1e-8);
  EXPECT_EQ(found(cube()).width, 0);
  EXPECT_TRUE(found(sphere(12)).curves.empty());
}

TEST(Facets, ThatMeetAtJustTheLimitAreSmooth) { EXPECT_EQ(found(tube(12)).faces.size(), 1U); }

TEST(Facets, KeepSoManyPointsOfARoundBorderThatItStaysRound) {
  const Facets facets = found(plate_with_small_hole(72));
  const auto in_hole =
      std::ranges::count_if(facets.corners, [&](int corner) { return facets.mesh.points[corner].norm() < 0.11; });
  EXPECT_GE(in_hole, 11);
  EXPECT_LE(in_hole, 13);
}

TEST(Facets, HaveTheNamesOfTheirGroupsAndSeamsBetweenThem) {
  TriangleMesh mesh = star({0, pi});
  mesh.groups = {"left", "right"};
  mesh.group_of = {0, 0, 1, -1};
  const Facets facets = found(std::move(mesh));
  EXPECT_THAT(facets.faces, ElementsAre("left", "right", "surface 1"));
  EXPECT_EQ(count(facets, CurveKind::seam), 2U);
  EXPECT_EQ(count(facets, CurveKind::fold), 0U);
}

TEST(Facets, AreTurnedAsMostOfTheirArea) {
  TriangleMesh mesh = cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const Facets facets = found(mesh);
  EXPECT_EQ(facets.turned, 1U);
  EXPECT_EQ(facets.faces.size(), 6U);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(found(mesh).turned, 1U);
}

TEST(Facets, ThatOccurTwiceAreTakenOnce) {
  TriangleMesh mesh = star({0});
  mesh.triangles.push_back({mesh.triangles[0][1], mesh.triangles[0][0], mesh.triangles[0][2]});
  const Facets facets = found(std::move(mesh));
  EXPECT_EQ(facets.repeated, 1U);
  EXPECT_EQ(facets.mesh.triangles.size(), 2U);
}

/// A square of two triangles, and a third one without area between them, with a point on the diagonal.
TEST(Facets, WithoutAreaAreGivenToTheirNeighbours) {
  const TriangleMesh mesh{.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                          .triangles = {{0, 1, 4}, {1, 2, 4}, {0, 4, 2}, {0, 2, 3}}};
  const Facets facets = found(mesh);
  EXPECT_EQ(facets.flat, 1U);
  EXPECT_EQ(facets.mesh.triangles.size(), 4U);
  EXPECT_NEAR(area_of(facets.mesh), 1, 1e-12);
  EXPECT_EQ(facets.faces.size(), 1U);
  EXPECT_EQ(facets.turned, 0U);
  TriangleMesh at_border = mesh;
  at_border.triangles.pop_back();
  EXPECT_NEAR(area_of(found(at_border).mesh), 0.5, 1e-12);
  EXPECT_EQ(found(at_border).mesh.triangles.size(), 2U);
}

TEST(Facets, OfWhichTwoCornersAreNearlyOneAreRemoved) {
  const Facets facets = found({.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1e-9, 0, 0}, {0, 0, -1}},
                               .triangles = {{4, 1, 2}, {0, 2, 3}, {0, 4, 2}, {0, 5, 4}, {4, 5, 1}}});
  EXPECT_EQ(facets.flat, 2U);
  EXPECT_EQ(facets.mesh.triangles.size(), 3U);
  EXPECT_EQ(facets.faces.size(), 2U);
}

TEST(Facets, ThatAreNoShellAreRefused) {
  EXPECT_THAT(refusal(star({0, pi / 2, pi})),
              AllOf(HasSubstr("part.stl: up to 3 triangles meet at 1 side"), HasSubstr(".msh")));
  Builder strip;
  strip.grid(24, 1, [](double s, double t) {
    const double r = 3 + (t - 0.5) * std::cos(pi * s), z = (t - 0.5) * std::sin(pi * s);
    return Vector3d(r * std::cos(2 * pi * s), r * std::sin(2 * pi * s), z);
  });
  EXPECT_THAT(refusal(strip.take()), HasSubstr("one side only"));
  EXPECT_THAT(refusal({.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {1, 1, 0}, {0, 1, 1}},
                       .triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}}),
              HasSubstr("has no area"));
}

}  // namespace
}  // namespace plastron::facets
