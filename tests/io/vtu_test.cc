#include <plastron/io/fields.hpp>
#include <plastron/io/vtu.hpp>
#include <plastron/mesh/basis.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>
#include <io/vtu_reader.hpp>

namespace plastron::io {

namespace {

using testing::Each;
using testing::UnorderedElementsAre;

constexpr double single_precision = 1e-6;

struct Written {
  computation::Result result;
  VtuFile file;
  std::vector<std::string> names;
};

/// Writes name.vtu and name.pvd.
void write_vtu(const computation::Solution& solution, const std::filesystem::path& directory, const std::string& name,
               const VtuChoice& choice = {}) {
  AtomicFiles files(MPI_COMM_WORLD);
  add_vtu(solution, directory / (name + ".vtu"), files, choice);
  add_pvd({{0, name + ".vtu"}}, directory / (name + ".pvd"), files);
  files.commit();
}

Written written(const PressedPlate& options, double displacement_scale = 1) {
  const ScratchDirectory scratch("vtu");
  Written w{.result = computation::solve(pressed_plate(options), MPI_COMM_WORLD), .file = {}, .names = {}};
  write_vtu(*w.result.solution, scratch.path, "plate", {.displacement_scale = displacement_scale});
  w.file = read_vtu(scratch.path / "plate.vtu");
  w.names = scratch.names();
  return w;
}

Eigen::Vector3d vector_at(const VtuArray& array, std::size_t point) {
  return Eigen::Map<const Eigen::Vector3d>(&array.values.at(3 * point));
}

TEST(Vtu, has_the_cells_of_the_mesh_with_their_own_points) {
  for (const int degree : {1, 2, 4}) {
    const Written w = written({.degree = degree});
    const auto per_cell = static_cast<std::size_t>((degree + 1) * (degree + 1));
    EXPECT_EQ(w.file.cells, 16U);
    EXPECT_EQ(w.file.points, 16U * per_cell);
    EXPECT_EQ(w.file.connectivity.size(), w.file.points);
    ASSERT_EQ(w.file.offsets.size(), w.file.cells);
    for (std::size_t cell = 0; cell < w.file.cells; ++cell)
      EXPECT_EQ(w.file.offsets[cell], static_cast<int>((cell + 1) * per_cell));
    constexpr int vtk_lagrange_quadrilateral = 70;
    EXPECT_EQ(w.file.types.size(), w.file.cells);
    EXPECT_THAT(w.file.types, Each(vtk_lagrange_quadrilateral));
    EXPECT_THAT(w.names, UnorderedElementsAre("plate.vtu", "plate.pvd"));
  }
}

TEST(Vtu, has_every_array_of_the_table_with_its_unit) {
  const Written w = written({});
  std::vector<std::string> expected{"points"};
  for (const Field& field : fields_of({.obstacle = true}))
    for (const std::string& name : field.arrays) {
      expected.emplace_back(name);
      ASSERT_TRUE(w.file.arrays.contains(expected.back())) << name;
      const VtuArray& array = w.file.arrays.at(expected.back());
      EXPECT_EQ(array.unit, field.unit) << name;
      EXPECT_EQ(array.components, field.is_vector() ? 3 : 1) << name;
      EXPECT_EQ(array.values.size(), w.file.points * static_cast<std::size_t>(array.components)) << name;
    }
  const VtuArray& errors = w.file.arrays.at("error_indicator");
  expected.emplace_back("error_indicator");
  EXPECT_EQ(errors.unit, "J");
  EXPECT_EQ(errors.values.size(), w.file.cells);
  EXPECT_EQ(w.file.arrays.size(), expected.size());
}

TEST(Vtu, without_obstacle_has_no_contact_arrays) {
  const Written w = written({.obstacle = false});
  for (const char* name : {"gap", "eta", "contact"}) EXPECT_FALSE(w.file.arrays.contains(name)) << name;
  EXPECT_TRUE(w.file.arrays.contains("displacement"));
}

TEST(Vtu, points_are_phi_plus_the_scaled_displacement) {
  for (const double scale : {1.0, 0.0, 25.0}) {
    const Written w = written({.degree = 3}, scale);
    double largest = 0;
    for (std::size_t p = 0; p < w.file.points; ++p) {
      const Eigen::Vector3d phi = vector_at(w.file.arrays.at("reference position"), p);
      const Eigen::Vector3d u = vector_at(w.file.arrays.at("displacement"), p);
      const Eigen::Vector3d expected = phi + scale * u;
      EXPECT_LT((vector_at(w.file.arrays.at("points"), p) - expected).norm(), 3 * single_precision);
      const Eigen::Vector3d chart(2 * w.file.arrays.at("x").values[p], w.file.arrays.at("y").values[p], 0.012);
      EXPECT_LT((phi - chart).norm(), 3 * single_precision);
      largest = std::max(largest, u.norm());
    }
    EXPECT_GT(largest, 0.0019) << "the plate must have moved down on the plane";
  }
}

/// The places of VTK's points of a Lagrange quadrilateral: corners, then sides 0-1, 1-2, 3-2, 0-3, then the inside by rows.
std::vector<std::array<int, 2>> lagrange_order(int k) {
  std::vector<std::array<int, 2>> order{{0, 0}, {k, 0}, {k, k}, {0, k}};
  for (int i = 1; i < k; ++i) order.push_back({i, 0});
  for (int i = 1; i < k; ++i) order.push_back({k, i});
  for (int i = 1; i < k; ++i) order.push_back({i, k});
  for (int i = 1; i < k; ++i) order.push_back({0, i});
  for (int j = 1; j < k; ++j)
    for (int i = 1; i < k; ++i) order.push_back({i, j});
  return order;
}

TEST(Vtu, lists_the_points_of_a_cell_in_the_order_of_a_lagrange_quadrilateral) {
  for (const int degree : {1, 2, 3, 5}) {
    const Written w = written({.degree = degree, .refinements = 0});
    const auto order = lagrange_order(degree);
    const VtuArray& phi = w.file.arrays.at("reference position");
    for (std::size_t cell = 0; cell < w.file.cells; ++cell) {
      const auto point = [&](std::size_t i) {
        return vector_at(phi, static_cast<std::size_t>(w.file.connectivity[cell * order.size() + i]));
      };
      const Eigen::Vector3d side1 = point(1) - point(0), side2 = point(3) - point(0);
      EXPECT_GT(side1.cross(side2).z(), 0);
      for (std::size_t i = 0; i < order.size(); ++i) {
        const Eigen::Vector3d expected =
            point(0) + double(order[i][0]) / degree * side1 + double(order[i][1]) / degree * side2;
        EXPECT_LT((point(i) - expected).norm(), single_precision) << "cell " << cell << " point " << i;
      }
    }
  }
}

// Corners around the cell, then the middles of its sides 0-1, 1-2, 2-0.
TEST(Vtu, lists_the_points_of_a_triangle_in_the_order_of_a_lagrange_triangle) {
  for (const int degree : {1, 2}) {
    const Written w = written({.degree = degree, .refinements = 1, .shape = mesh::Shape::triangle});
    const std::size_t per_cell = degree == 1 ? 3 : 6;
    ASSERT_EQ(w.file.cells, 64U);
    ASSERT_EQ(w.file.points, 64U * per_cell);
    constexpr int vtk_lagrange_triangle = 69;
    EXPECT_THAT(w.file.types, Each(vtk_lagrange_triangle));
    const VtuArray &phi = w.file.arrays.at("reference position"), &x = w.file.arrays.at("x");
    double area = 0;
    for (std::size_t cell = 0; cell < w.file.cells; ++cell) {
      EXPECT_EQ(w.file.offsets[cell], static_cast<int>((cell + 1) * per_cell));
      const auto index = [&](std::size_t i) {
        return static_cast<std::size_t>(w.file.connectivity[cell * per_cell + i]);
      };
      const auto point = [&](std::size_t i) { return vector_at(phi, index(i)); };
      const double doubled = (point(1) - point(0)).cross(point(2) - point(0)).z();
      EXPECT_GT(doubled, 0);
      area += doubled / 2;
      for (std::size_t side = 0; degree == 2 && side < 3; ++side)
        EXPECT_LT((point(3 + side) - (point(side) + point((side + 1) % 3)) / 2).norm(), single_precision);
      for (std::size_t i = 0; i < per_cell; ++i) EXPECT_NEAR(2 * x.values[index(i)], point(i)[0], 3 * single_precision);
    }
    EXPECT_NEAR(area, 2, 1e-5);
  }
}

// The reaction of a cell is that of its nodes with a weight: linear through the vertices (degree 1) or through the
// middles of the sides (degree 2), so its integral is the area times the mean of three values.
TEST(Vtu, of_triangles_has_a_pressure_whose_integral_is_the_reaction) {
  for (const int degree : {1, 2}) {
    const Written w = written({.degree = degree, .refinements = 2, .shape = mesh::Shape::triangle});
    const std::size_t per_cell = degree == 1 ? 3 : 6;
    const VtuArray &phi = w.file.arrays.at("reference position"), &eta = w.file.arrays.at("eta");
    double sum = 0;
    for (std::size_t cell = 0; cell < w.file.cells; ++cell) {
      const auto at = [&](std::size_t i) { return static_cast<std::size_t>(w.file.connectivity[cell * per_cell + i]); };
      const double area =
          (vector_at(phi, at(1)) - vector_at(phi, at(0))).cross(vector_at(phi, at(2)) - vector_at(phi, at(0))).norm() /
          2;
      for (std::size_t i = 0; i < 3; ++i) sum += area / 3 * eta.values[at(i)];  // mean of a linear function
    }
    const double reaction = w.result.summary.reaction.force[2];
    EXPECT_GT(reaction, 0);
    EXPECT_NEAR(sum, reaction, 1e-5 * reaction);
  }
}

/// Sum over the cells of the nodal quadrature of eta, with equidistant points that are nodes: degrees 1 and 2.
double integral_of_eta(const VtuFile& file, int degree) {
  const auto weights = mesh::gauss_lobatto(degree + 1).weights;
  const auto order = lagrange_order(degree);
  double sum = 0;
  for (std::size_t cell = 0; cell < file.cells; ++cell) {
    const int* point = &file.connectivity[cell * order.size()];
    const auto phi = [&](int i) {
      return vector_at(file.arrays.at("reference position"), static_cast<std::size_t>(point[i]));
    };
    const double area = (phi(1) - phi(0)).cross(phi(3) - phi(0)).norm();
    for (std::size_t i = 0; i < order.size(); ++i)
      sum += area * weights[static_cast<std::size_t>(order[i][0])] * weights[static_cast<std::size_t>(order[i][1])] *
             file.arrays.at("eta").values[static_cast<std::size_t>(point[i])];
  }
  return sum;
}

TEST(Vtu, eta_is_a_pressure_whose_integral_is_the_reaction) {
  for (const int degree : {1, 2}) {
    const Written w = written({.degree = degree, .refinements = 2});
    const double reaction = w.result.summary.reaction.force.z();
    ASSERT_EQ(w.result.status, contact::Status::solved);
    ASSERT_GT(reaction, 100) << "the plate must press on the plane";
    EXPECT_NEAR(integral_of_eta(w.file, degree), reaction, single_precision * reaction);
  }
}

TEST(Vtu, in_double_precision_has_all_digits) {
  const ScratchDirectory scratch("vtu");
  const computation::Result result = computation::solve(pressed_plate({.degree = 3}), MPI_COMM_WORLD);
  write_vtu(*result.solution, scratch.path, "single");
  write_vtu(*result.solution, scratch.path, "double", {.is_double = true});
  const VtuFile single = read_vtu(scratch.path / "single.vtu"), exact = read_vtu(scratch.path / "double.vtu");
  ASSERT_EQ(exact.points, single.points);
  ASSERT_EQ(exact.arrays.size(), single.arrays.size());
  double rounded = 0;
  for (const auto& [name, array] : exact.arrays)
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      EXPECT_EQ(static_cast<float>(array.values[i]), single.arrays.at(name).values[i]) << name;
      rounded = std::max(rounded, std::abs(array.values[i] - static_cast<float>(array.values[i])));
    }
  EXPECT_GT(rounded, 0);
}

TEST(Vtu, has_stresses_at_the_heights_that_are_asked_for) {
  const ScratchDirectory scratch("vtu");
  const computation::Result result = computation::solve(pressed_plate({}), MPI_COMM_WORLD);
  write_vtu(*result.solution, scratch.path, "plate", {.heights = {-0.5, 0.125}, .is_double = true});
  const VtuFile file = read_vtu(scratch.path / "plate.vtu");
  const auto array = [&](const std::string& name) -> const VtuArray& { return file.arrays.at(name); };
  double largest = 0;
  for (std::size_t p = 0; p < file.points; ++p) {
    const double middle = array("stress_11_middle").values[p], upper = array("stress_11_upper").values[p];
    largest = std::max(largest, std::abs(upper));
    EXPECT_EQ(array("stress_11_at_-0.5").values[p], array("stress_11_lower").values[p]);
    EXPECT_NEAR(array("stress_11_at_0.125").values[p], middle + 0.25 * (upper - middle), 1e-12 * std::abs(upper));
    EXPECT_EQ(array("shear_stress_1_at_-0.5").values[p], 0);
    EXPECT_NEAR(array("shear_stress_1_at_0.125").values[p], 1.5 * (1 - 0.0625) * array("shear_stress_1").values[p],
                1e-12 * std::abs(array("shear_stress_1").values[p]));
  }
  EXPECT_GT(largest, 0);
  EXPECT_EQ(array("von_mises_at_0.125").unit, "Pa");
}

TEST(Vtu, leaves_out_ranks_without_cells) {
  const Written w = written({.cells = 1, .refinements = 0});
  EXPECT_EQ(w.file.cells, 1U);
  EXPECT_EQ(w.file.pieces, 1);
}

TEST(Vtu, a_directory_that_is_not_there_is_an_error_with_its_name) {
  const computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  try {
    write_vtu(*result.solution, "/nowhere/at/all", "plate");
    FAIL() << "no error";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("/nowhere/at/all/plate.vtu"));
  }
}

}  // namespace

}  // namespace plastron::io
