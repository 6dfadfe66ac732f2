// solid.vtu, read back: it fills the volume between the faces, and its stresses integrate to resultants.
#include <plastron/io/vtu.hpp>
#include <plastron/workflow/output.hpp>

#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>
#include <io/vtu_reader.hpp>

#include <Eigen/Geometry>

namespace plastron::io::solid_test {

namespace {

using Eigen::Vector3d;
using workflow::Output;

constexpr int layers = 3;

struct Solid {
  VtuFile solid, surface;
  const VtuArray& operator[](const char* name) const { return solid.arrays.at(name); }
};

Solid written(const PressedPlate& options) {
  const ScratchDirectory scratch("solid");
  const computation::Result result = computation::solve(pressed_plate(options), MPI_COMM_WORLD);
  Output(scratch.path, "solution", MPI_COMM_WORLD, false, {.double_precision = true, .solid_layers = layers})
      .finish(result, {});
  Solid s{.solid = read_vtu(scratch.path / "solid.vtu"), .surface = read_vtu(scratch.path / "solution.vtu")};
  MPI_Barrier(MPI_COMM_WORLD);
  return s;
}

Vector3d vector_of(const VtuArray& array, std::size_t point) {
  return Eigen::Map<const Vector3d>(&array.values.at(3 * point));
}

/// Volume of a straight prism: base times height, with the sign of VTK's order of its corners.
double prism_volume(const Solid& s, std::size_t cell, std::size_t corners) {
  const auto at = [&](std::size_t i) {
    return vector_of(s["reference position"], static_cast<std::size_t>(s.solid.connectivity[2 * corners * cell + i]));
  };
  const double base = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(corners) - at(0));
  return corners == 4 ? base : -base / 2;
}

TEST(SolidVtu, FillsTheVolumeBetweenTheFaces) {
  for (const mesh::Shape shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle})
    for (const int degree : {1, 2}) {
      const Solid s = written({.degree = degree, .shape = shape});
      const std::size_t corners = shape == mesh::Shape::triangle ? 3 : 4;
      EXPECT_EQ(s.solid.cells, s.surface.cells * static_cast<std::size_t>(degree * degree * layers));
      for (const int type : s.solid.types) ASSERT_EQ(type, corners == 3 ? 13 : 12);
      double volume = 0;
      for (std::size_t cell = 0; cell < s.solid.cells; ++cell) {
        EXPECT_GT(prism_volume(s, cell, corners), 0);
        volume += prism_volume(s, cell, corners);
      }
      EXPECT_NEAR(volume, 2 * 0.02, 1e-14);
    }
}

TEST(SolidVtu, HasDisplacementsLinearAndStressesOfTheModelThroughTheThickness) {
  const Solid s = written({.degree = 2});
  const std::size_t sheet = 9, cell_points = sheet * (layers + 1);
  double bent = 0;
  for (std::size_t first = 0; first < s.solid.points; first += cell_points)
    for (std::size_t p = first; p < first + sheet; ++p) {
      const std::size_t top = p + layers * sheet, next = p + sheet;
      EXPECT_NEAR(s["z"].values[p], -0.01, 1e-16);
      EXPECT_NEAR(s["z"].values[top], 0.01, 1e-16);
      const auto between = [&](const VtuArray& a) -> Vector3d { return (2 * vector_of(a, p) + vector_of(a, top)) / 3; };
      EXPECT_LT((vector_of(s["displacement"], next) - between(s["displacement"])).norm(), 1e-16);
      const Vector3d moved = vector_of(s["reference position"], next) + vector_of(s["displacement"], next);
      EXPECT_LT((vector_of(s["points"], next) - moved).norm(), 1e-15);
      const auto& stress = s["stress_11"].values;
      EXPECT_NEAR(stress[next], (2 * stress[p] + stress[top]) / 3, 1e-12 * std::abs(stress[top]) + 1e-9);
      bent = std::max(bent, std::abs(stress[p] - stress[top]));
      EXPECT_EQ(s["shear_stress_1"].values[p], 0);
      // t1 is the x axis on this plate: the tensor in space has the same components, XX YY ZZ XY YZ XZ.
      EXPECT_NEAR(s["stress"].values[6 * next], stress[next], 1e-12 * std::abs(stress[next]));
      EXPECT_EQ(s["stress"].values[6 * next + 2], 0);
      EXPECT_NEAR(s["stress"].values[6 * next + 5], s["shear_stress_1"].values[next], 1e-9);
    }
  EXPECT_GT(bent, 1e3);
}

TEST(SolidVtu, MarksTheFaceThatTouches) {
  const Solid s = written({.degree = 2, .refinements = 2});
  std::size_t touching = 0;
  for (std::size_t p = 0; p < s.solid.points; ++p) {
    if (s["contact"].values[p] == 0 && s["eta"].values[p] == 0) continue;
    ++touching;
    EXPECT_NEAR(s["z"].values[p], -0.01, 1e-16) << "the plate meets the plane with its lower face";
  }
  std::size_t on_surface = 0;
  for (std::size_t p = 0; p < s.surface.points; ++p)
    if (s.surface.arrays.at("contact").values[p] != 0 || s.surface.arrays.at("eta").values[p] != 0) ++on_surface;
  EXPECT_GT(touching, 0U);
  EXPECT_EQ(touching, on_surface);
  const Solid free = written({.obstacle = false});
  EXPECT_FALSE(free.solid.arrays.contains("contact"));
  EXPECT_FALSE(free.solid.arrays.contains("eta"));
}

TEST(SolidVtu, IsThereOnlyIfAskedForAndGoesOtherwise) {
  const ScratchDirectory scratch("solid");
  const computation::Result result = computation::solve(pressed_plate({}), MPI_COMM_WORLD);
  Output(scratch.path, "solution", MPI_COMM_WORLD, false, {.solid_layers = 1}).finish(result, {});
  EXPECT_TRUE(std::filesystem::exists(scratch.path / solid_name));
  MPI_Barrier(MPI_COMM_WORLD);
  Output(scratch.path, "solution", MPI_COMM_WORLD, false).finish(result, {});
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(std::filesystem::exists(scratch.path / solid_name));
  MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace

}  // namespace plastron::io::solid_test
