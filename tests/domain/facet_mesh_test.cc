// Facets as a mesh in space: names, folds, size, and what is refused.
#include "domain/mutator.hpp"
#include "domain/written_mesh.hpp"

#include <plastron/domain/surface_mesh.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

namespace plastron::domain {
namespace {

using std::numbers::pi;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string facet(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  std::string text = "facet normal 0 0 0\nouter loop\n";
  for (const Vector3d& x : {a, b, c}) text += fmt::format("vertex {:.17g} {:.17g} {:.17g}\n", x[0], x[1], x[2]);
  return text + "endloop\nendfacet\n";
}

std::string quadrilateral(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return facet(a, b, c) + facet(a, c, d);
}

const std::string floor_facets = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
const std::string wall_facets = quadrilateral({0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0});

/// A tube of radius 1 and length 2 of facets from end to end.
std::string tube(int columns) {
  std::string text = "solid\n";
  for (int i = 0; i < columns; ++i) {
    const auto at = [&](int k, double z) {
      const double a = 2 * pi * (k % columns) / columns;
      return Vector3d(std::cos(a), std::sin(a), z);
    };
    text += quadrilateral(at(i, 0), at(i + 1, 0), at(i + 1, 2), at(i, 2));
  }
  return text + "endsolid\n";
}

/// Two squares with a gap between them.
std::string beside(double gap) {
  return "solid\n" + floor_facets + quadrilateral({1 + gap, 0, 0}, {2 + gap, 0, 0}, {2 + gap, 1, 0}, {1 + gap, 1, 0}) +
         "endsolid\n";
}

/// Facets of a cube.
std::string cube() {
  const Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return "solid box\n" + quadrilateral(o, y, x + y, x) + quadrilateral(o, z, y + z, y) + quadrilateral(o, x, x + z, z) +
         quadrilateral(z, x + z, x + y + z, y + z) + quadrilateral(x, x + y, x + y + z, x + z) +
         quadrilateral(y, y + z, x + y + z, x + y) + "endsolid box\n";
}

FileSurface facet_surface(const std::string& text, SpaceReading reading = {}, std::optional<mesh::Shape> shape = {},
                          const std::string& name = ".stl") {
  const written::TemporaryPath path(name);
  std::ofstream(path.path) << text;
  return read_surface({.path = path.path.string(), .in_space = std::move(reading)}, shape);
}

std::string facet_refusal(const std::string& text, SpaceReading reading = {}) {
  try {
    facet_surface(text, std::move(reading));
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(FacetMesh, HasTheNamesOfItsSolidsAndOfItsEdges) {
  const FileSurface surface =
      facet_surface("solid floor\n" + floor_facets + "endsolid floor\nsolid wall\n" + wall_facets + "endsolid wall\n");
  EXPECT_THAT(surface.regions, ElementsAre("floor", "wall"));
  EXPECT_EQ(surface.boundaries.size(), 7U);
  EXPECT_EQ(surface.boundaries.front(), "edge 1");
  const topology::SurfaceSummary summary = topology::summary_of(surface.topology);
  EXPECT_NEAR(summary.area, 2, 1e-9);
  EXPECT_EQ(surface.topology.sheet_count, 2);
  const mesh::CoarseMesh mesh = surface_mesh(surface, mesh::Shape::quadrilateral);
  EXPECT_THAT(mesh.fold_boundaries, ElementsAre("fold 1"));
}

TEST(FacetMesh, WithoutNamesHasNumberedSurfaces) {
  const FileSurface surface = facet_surface("solid\n" + floor_facets + wall_facets + "endsolid\n");
  EXPECT_THAT(surface.regions, ElementsAre("surface 1", "surface 2"));
}

/// With twelve cells round the tube, neighbours meet at 30 degrees: whether they are smooth is known from the facets.
TEST(FacetMesh, HasFoldsWhereTheFacetsHaveSomeWhateverTheSizeOfItsCells) {
  for (const double size : {0.05, 0.1, 0.6}) {
    const FileSurface surface = facet_surface(tube(72), {.size = size});
    EXPECT_EQ(surface.topology.sheet_count, 1) << size;
    EXPECT_THAT(surface.boundaries, ElementsAre("edge 1", "edge 2"));
  }
  EXPECT_EQ(facet_surface(tube(72), {.smooth_angle = pi / 60, .size = 0.1}).topology.sheet_count, 72);
}

TEST(FacetMesh, HasTheSizeAndTheScaleThatTheCaseNames) {
  const FileSurface fine = facet_surface(tube(72), {.size = 0.1}),
                    large = facet_surface(tube(72), {.scale = 10, .size = 1.0});
  EXPECT_NEAR(static_cast<double>(fine.topology.mesh.cells.size()), 4 * pi / 0.01, 0.3 * 4 * pi / 0.01);
  EXPECT_NEAR(static_cast<double>(large.topology.mesh.cells.size()), 4 * pi / 0.01, 0.3 * 4 * pi / 0.01);
  EXPECT_NEAR(topology::summary_of(large.topology).area, 400 * pi, 0.01 * 400 * pi);
  const FileSurface by_default = facet_surface(tube(80));
  EXPECT_NEAR(static_cast<double>(by_default.topology.mesh.cells.size()), 2000, 400);
  EXPECT_THAT(by_default.notes, Contains(AllOf(HasSubstr("160 facets"), HasSubstr("size"), HasSubstr("STEP"))));
}

TEST(FacetMesh, OfCoarseFacetsHasCellsAsWideAsTheFacetsAndAWarning) {
  const FileSurface coarse = facet_surface(tube(36)), fine = facet_surface(tube(240)),
                    small = facet_surface(tube(72), {.size = 0.05});
  EXPECT_LT(coarse.topology.mesh.cells.size(), 700U);
  EXPECT_THAT(coarse.warnings, Contains(HasSubstr("meet at 10 degrees on the mean")));
  EXPECT_THAT(fine.warnings, IsEmpty());
  EXPECT_THAT(small.warnings, ElementsAre(HasSubstr("smaller (size 0.05 m) than the facets are wide (about 0.0872 m")));
}

TEST(FacetMesh, WhoseAnglesAreNearTheLimitHasAWarning) {
  EXPECT_THAT(facet_surface(tube(18)).warnings, Contains(HasSubstr("20 degrees count as smooth")));
  EXPECT_THAT(facet_surface(tube(8)).warnings, Contains(HasSubstr("45 degrees count as a fold")));
  EXPECT_THAT(facet_surface(cube()).warnings, IsEmpty());
}

TEST(FacetMesh, WithGapsIsRefusedUnlessTheyAreClosedOrMeant) {
  EXPECT_THAT(facet_refusal(beside(1e-3)),
              AllOf(HasSubstr("2 corners"), HasSubstr("up to 0.001 m away"), HasSubstr("set tolerance = 0.0011")));
  const FileSurface closed = facet_surface(beside(1e-3), {.tolerance = 1.1e-3});
  EXPECT_EQ(closed.topology.part_count, 1);
  EXPECT_THAT(closed.notes, Contains(HasSubstr("2 points at open sides were joined with others, up to 0.001 m away")));
  EXPECT_EQ(facet_surface(beside(1e-3), {.has_slits = true}).topology.part_count, 2);
}

TEST(FacetMesh, CanConsistOfTriangles) {
  const FileSurface surface = facet_surface(tube(72), {.size = 0.2}, mesh::Shape::triangle);
  EXPECT_EQ(surface.topology.mesh.shape, mesh::Shape::triangle);
  EXPECT_EQ(surface_mesh(surface, mesh::Shape::triangle).shape, mesh::Shape::triangle);
}

/// A square of 10 m with a bump of a height and a radius in the middle, where the facets are fine.
std::string bump(double height, double radius) {
  constexpr int n = 20;
  const auto coordinate = [](int i) { return 5 * std::pow(static_cast<double>(i) / n, 3); };
  const auto at = [&](int i, int j) {
    const double x = coordinate(i), y = coordinate(j);
    return Vector3d(x, y, height * std::exp(-(x * x + y * y) / (radius * radius)));
  };
  std::string text = "solid\n";
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) text += quadrilateral(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return text + "endsolid\n";
}

TEST(FacetMesh, OfFeaturesNarrowerThanTheUsualCellsHasSmallerCellsOrThoseOfItsFacets) {
  const auto about = [](const char* text) { return Contains(HasSubstr(text)); };
  const FileSurface wide = facet_surface(bump(2, 0.3)), narrow = facet_surface(bump(1, 0.1));
  EXPECT_THAT(wide.notes, AllOf(about("were remeshed"), about("larger cells fold")));
  EXPECT_THAT(narrow.notes, AllOf(about("were divided into quadrilaterals"), about("larger cells fold")));
  EXPECT_THAT(facet_refusal(bump(2, 0.3), {.size = std::sqrt(1.0 / 20)}), HasSubstr("or take another size"));
  EXPECT_THAT(facet_surface(cube()).notes, testing::Not(about("larger cells fold")));
}

/// Names of files and folds are no reasons.
TEST(FacetMesh, DoesNotDependOnTheWordsOfItsFile) {
  for (const char* name : {".stl", " border.stl", " element .stl"}) {
    EXPECT_THAT(facet_surface(bump(2, 0.3), {}, {}, name).notes, Contains(HasSubstr("larger cells fold")));
    for (const char* fold : {"bend", " element ", "border"}) try {
        facet_surface(cube(), {.folds = {fold}}, {}, name);
        ADD_FAILURE() << "accepted";
      } catch (const mesh::DomainError& error) {
        EXPECT_THAT(error.what(), testing::Not(HasSubstr("cells that were made from the facets"))) << name << fold;
      }
  }
}

TEST(FacetMesh, IsTheSameOnEveryReading) {
  const auto nodes = [] { return facet_surface(tube(36)).topology.mesh.nodes; };
  EXPECT_EQ(nodes(), nodes());
}

TEST(FacetMesh, ThatCannotBeMadeIsRefusedWithItsFile) {
  EXPECT_THAT(facet_refusal("solid\nendsolid\n"), AllOf(HasSubstr(".stl"), HasSubstr("has no triangles")));
  EXPECT_THAT(facet_refusal("solid\nfacet normal 0 0 0\nouter loop\nvertex 0 nan 0\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("finite numbers")));
  const std::string third = quadrilateral({0, 0, 0}, {-1, 0, 0}, {-1, 1, 0}, {0, 1, 0});
  EXPECT_THAT(facet_refusal("solid\n" + floor_facets + wall_facets + third + "endsolid\n"),
              AllOf(HasSubstr("3 triangles meet"), HasSubstr("give the .msh file")));
  EXPECT_THAT(facet_refusal("solid\n" + floor_facets + "endsolid\n", {.size = 1e-4}),
              AllOf(HasSubstr("size = 0.0016"), HasSubstr("cells; at most")));
  const std::string touching = quadrilateral({1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0});
  EXPECT_THAT(facet_refusal("solid\n" + floor_facets + touching + "endsolid\n"),
              AllOf(HasSubstr("only at a point (1, 1, 0)"), HasSubstr("cells that were made from the facets")));
  EXPECT_THAT(facet_refusal("solid\n" + floor_facets + "endsolid\n", {.folds = {"bend"}}),
              AllOf(HasSubstr("no curve \"bend\""), HasSubstr("edge 1")));
}

/// Returns whether the facets become a mesh. Other exceptions than DomainError end the test.
bool is_mesh(const std::string& text) {
  try {
    const FileSurface surface = facet_surface(text);
    EXPECT_LT(surface.topology.mesh.cells.size(), 20000U);
    return true;
  } catch (const mesh::DomainError& error) {
    EXPECT_LT(std::string(error.what()).size(), 2000U);
    return false;
  }
}

TEST(FacetMesh, OfADamagedFileIsMadeOrRefusedInNoTime) {
  constexpr int mutants = 150;
  Mutator mutate("facet", " \n\t");
  int made = 0, refused = 0;
  ASSERT_TRUE(is_mesh(cube()));
  for (int i = 0; i < mutants; ++i) {
    const std::string mutant = mutate(cube());
    const std::clock_t begin = std::clock();
    ++(is_mesh(mutant) ? made : refused);
    EXPECT_LT(std::clock() - begin, 20 * CLOCKS_PER_SEC) << mutant;
  }
  EXPECT_GT(made, 0);  // most changes open the cube
  EXPECT_GT(refused, 30);
}

/// Corners that are moved, made one or exchanged by chance.
TEST(FacetMesh, OfDamagedTrianglesIsMadeOrRefusedInNoTime) {
  std::mt19937 random(7);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int made = 0;
  for (int i = 0; i < 150; ++i) {
    constexpr int rows = 6, columns = 7;
    std::vector<Vector3d> x;
    for (int k = 0; k <= rows; ++k)
      for (int l = 0; l <= columns; ++l) x.emplace_back(l, k, 0.1 * l * l);
    for (int change = 0; change < 2; ++change) {
      Vector3d &a = x[below(static_cast<int>(x.size()))], &b = x[below(static_cast<int>(x.size()))];
      const Vector3d way = b - a;
      constexpr double parts[] = {1, 0.5, 0.999999, 1e6, -1e-7};
      a += parts[below(5)] * way;
    }
    std::string text = "solid\n";
    for (int k = 0; k < rows; ++k)
      for (int l = 0; l < columns; ++l) {
        const int first = k * (columns + 1) + l;
        if (below(40) == 0) continue;
        text += quadrilateral(x[first], x[first + 1], x[first + columns + 2], x[first + columns + 1]);
      }
    const std::clock_t begin = std::clock();
    made += is_mesh(text + "endsolid\n") ? 1 : 0;
    EXPECT_LT(std::clock() - begin, 20 * CLOCKS_PER_SEC) << text;
  }
  EXPECT_GT(made, 30);
}

}  // namespace
}  // namespace plastron::domain
