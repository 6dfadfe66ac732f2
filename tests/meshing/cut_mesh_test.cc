// Chords of coarse meshes, and meshes that are cut along them.
#include <gtest/gtest.h>
#include <plastron/algebra/vector.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/cut_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/meshing/chord_cuts.hpp>

#include <cmath>
#include <set>

namespace plastron::fem::cut_mesh_test {
namespace {

mesh::CoarseMesh grid(std::size_t columns, std::size_t rows) {
  std::vector<Vector2d> vertices;
  for (std::size_t j = 0; j <= rows; ++j)
    for (std::size_t i = 0; i <= columns; ++i) vertices.emplace_back(static_cast<double>(i), static_cast<double>(j));
  mesh::CoarseMesh mesh = domain::grid_mesh(std::move(vertices), columns);
  mesh.boundaries = {"left", "right", "bottom", "top"};
  return mesh;
}

double area_of(const mesh::CoarseMesh& mesh) {
  double sum = 0;
  for (const mesh::CoarseCell& cell : mesh.cells) {
    const auto at = [&](int k) {
      return mesh.vertices[static_cast<std::size_t>(cell.vertices[static_cast<std::size_t>(k)])];
    };
    const Vector2d a = at(3) - at(0), b = at(2) - at(1);
    sum += std::abs(a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

TEST(Chords, OfAGridAreItsRowsAndColumns) {
  const meshing::Chords all = meshing::chords(grid(3, 2));
  EXPECT_EQ(all.count, 5);
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(all.of_cell[3 * j + i][0], all.of_cell[i][0]);
      EXPECT_EQ(all.of_cell[3 * j + i][1], all.of_cell[3 * j][1]);
    }
}

/// One ring around the square in the middle, and one chord from rim to rim through it in each direction.
TEST(Chords, OfADiskAreARingAndACross) {
  const meshing::Chords all = meshing::chords(domain::disk_mesh({{0, 0}, 1}));
  EXPECT_EQ(all.count, 3);
  for (std::size_t c = 1; c < 5; ++c) EXPECT_EQ(all.of_cell[c][0], all.of_cell[1][0]);
  EXPECT_EQ(all.of_cell[1][1], all.of_cell[3][1]);
  EXPECT_EQ(all.of_cell[2][1], all.of_cell[4][1]);
}

TEST(CutMesh, CoversTheSameWithMoreCells) {
  MeshSequence meshes(grid(3, 2), 2, MPI_COMM_WORLD);
  std::vector<mesh::Cuts> cuts(6);
  // The first column and the second row, in whatever way the cells were turned: all cells of a chord.
  const mesh::CoarseMesh& coarse = *meshes.space()->coarse;
  const meshing::Chords all = meshing::chords(coarse);
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t d = 0; d < 2; ++d)
      if (all.of_cell[c][d] == all.of_cell[0][0] || all.of_cell[c][d] == all.of_cell[5][1]) cuts[c][d] = {0.25};
  EXPECT_TRUE(are_conforming(coarse, cuts));
  meshes.cut({}, cuts);
  EXPECT_EQ(meshes.space()->global_cells, 12);
  EXPECT_EQ(meshes.space()->layout->global_size, 9 * 7);
  EXPECT_NEAR(area_of(*meshes.space()->coarse), 6, 1e-12);
  EXPECT_EQ(meshes.space()->coarse->edges.size(), 2U * (4 + 3));
}

/// Drawn down and drawn up: the conormal of a curve inside points to its right, and that side stays the right one.
TEST(CutMesh, KeepsTheDirectionOfCurves) {
  mesh::CoarseMesh mesh = grid(2, 1);
  mesh.boundaries = {"down", "up"};
  mesh.edges = {{{4, 1}, 0}, {{1, 4}, 1}};
  const mesh::CoarseMesh cut =
      cut_mesh(mesh, std::vector<mesh::Cuts>(2, mesh::Cuts{std::vector<double>{}, std::vector{0.3, 0.8}}));
  ASSERT_EQ(cut.edges.size(), 6U);
  for (const mesh::BoundaryEdge& edge : cut.edges) {
    const double step = cut.vertices[static_cast<std::size_t>(edge.vertices[1])][1] -
                        cut.vertices[static_cast<std::size_t>(edge.vertices[0])][1];
    EXPECT_GT(edge.boundary == 0 ? -step : step, 0);
  }
}

TEST(CutMesh, KnowsCutsThatDoNotMeet) {
  const mesh::CoarseMesh mesh = grid(2, 1);
  std::vector<mesh::Cuts> cuts(2);
  cuts[0][1] = {0.3};
  EXPECT_FALSE(are_conforming(mesh, cuts));
  cuts[1][1] = {0.4};
  EXPECT_FALSE(are_conforming(mesh, cuts));
  cuts[1][1] = {0.3};
  EXPECT_TRUE(are_conforming(mesh, cuts));
  EXPECT_FALSE(are_conforming(mesh, std::vector<mesh::Cuts>(3)));
}

Vector2d position(const Space& space, std::size_t cell, const Vector2d& xi) {
  const Cell& c = space.cells[cell];
  return space.coarse->cells[static_cast<std::size_t>(c.coarse)].map(c.corner + c.size * xi).value;
}

/// A function of Omega and a constant, at the nodes of elements of degree 4.
algebra::Vector sampled(const Space& space, double (*f)(const Vector2d&)) {
  algebra::Vector field(space.layout, 2);
  const double half = std::sqrt(3.0 / 7) / 2;
  const std::vector<double> nodes{0, 0.5 - half, 0.5, 0.5 + half, 1};
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (std::size_t i = 0; i < 25; ++i) {
      const auto node = static_cast<std::size_t>(space.nodes(cell)[i]);
      if (node >= static_cast<std::size_t>(space.layout->owned)) continue;
      field.owned()[2 * node] = f(position(space, cell, {nodes[i % 5], nodes[i / 5]}));
      field.owned()[2 * node + 1] = 1;
    }
  field.update_ghosts();
  return field;
}

double quartic(const Vector2d& x) { return std::pow(x[0], 4) - 2 * x[0] * std::pow(x[1], 3) + x[1]; }

/// A field cut three times stays the same, on any number of ranks.
TEST(CutMesh, KeepsPolynomials) {
  MeshSequence meshes(grid(3, 2), 4, MPI_COMM_WORLD);
  std::vector<algebra::Vector> fields{sampled(*meshes.space(), quartic)};
  for (const double at : {0.2, 0.7, 0.4}) {
    const mesh::CoarseMesh& coarse = *meshes.space()->coarse;
    const meshing::Chords all = meshing::chords(coarse);
    std::vector<mesh::Cuts> cuts(coarse.cells.size());
    const std::set<int> cut{all.of_cell[1][0], all.of_cell[coarse.cells.size() - 1][1]};
    for (std::size_t c = 0; c < cuts.size(); ++c)
      for (std::size_t d = 0; d < 2; ++d)
        if (cut.contains(all.of_cell[c][d])) cuts[c][d] = {at};
    meshes.cut(fields, cuts);
    const algebra::Vector wanted = sampled(*meshes.space(), quartic);
    ASSERT_EQ(fields[0].local().size(), wanted.local().size());
    for (std::size_t i = 0; i < wanted.local().size(); ++i) EXPECT_NEAR(fields[0].local()[i], wanted.local()[i], 1e-11);
  }
  // The cuts alone, all at once, give the same mesh.
  MeshSequence again(grid(3, 2), 4, MPI_COMM_WORLD);
  again.begin_with_cuts(meshes.space()->coarse->cuts);
  ASSERT_EQ(again.space()->owned_cells, meshes.space()->owned_cells);
  for (std::size_t c = 0; c < again.space()->owned_cells; ++c)
    EXPECT_LT((position(*again.space(), c, {0.3, 0.6}) - position(*meshes.space(), c, {0.3, 0.6})).norm(), 1e-12);
}

/// A polynomial in the own coordinates of cells stays one, also in bent cells and in cells that were turned for the sequence.
TEST(CutMesh, KeepsFieldsOnBentCells) {
  MeshSequence meshes(domain::disk_mesh({{0.3, 0.2}, 1}), 4, MPI_COMM_WORLD);
  const auto at_nodes = [&](double power) {
    algebra::Vector field(meshes.space()->layout, 1);
    const Space& space = *meshes.space();
    const std::vector<CutCell> parts = cut_cells(*space.coarse);
    const double half = std::sqrt(3.0 / 7) / 2;
    const std::vector<double> nodes{0, 0.5 - half, 0.5, 0.5 + half, 1};
    for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
      for (std::size_t i = 0; i < 25; ++i) {
        const auto node = static_cast<std::size_t>(space.nodes(cell)[i]);
        if (node >= static_cast<std::size_t>(space.layout->owned)) continue;
        const CutCell& part = parts[static_cast<std::size_t>(space.cells[cell].coarse)];
        const Vector2d xi = part.corner + part.size.cwiseProduct(Vector2d(nodes[i % 5], nodes[i / 5]));
        // Vanishes on all sides of the first cells, so that it is one field.
        field.owned()[node] = (1 + static_cast<double>(part.first)) * std::pow(xi[0] * xi[1], power) * (1 - xi[0]) *
                              (1 - xi[1]) * (2 + xi[0] - xi[1]);
      }
    field.update_ghosts();
    return field;
  };
  std::vector<algebra::Vector> fields{at_nodes(1), at_nodes(2)};
  for (const double at : {0.3, 0.6}) {
    const meshing::Chords all = meshing::chords(*meshes.space()->coarse);
    std::vector<mesh::Cuts> cuts(meshes.space()->coarse->cells.size());
    for (std::size_t c = 0; c < cuts.size(); ++c)
      for (std::size_t d = 0; d < 2; ++d)
        if (all.of_cell[c][d] != all.of_cell[0][0]) cuts[c][d] = {at};
    ASSERT_TRUE(are_conforming(*meshes.space()->coarse, cuts));
    meshes.cut(fields, cuts);
    const std::array wanted{at_nodes(1), at_nodes(2)};
    for (std::size_t f = 0; f < 2; ++f)
      for (std::size_t i = 0; i < wanted[f].local().size(); ++i)
        EXPECT_NEAR(fields[f].local()[i], wanted[f].local()[i], 1e-11);
  }
}

TEST(CutMesh, DividesAfterwardsAsAnyOther) {
  MeshSequence meshes(domain::disk_mesh({{0, 0}, 1}), 2, MPI_COMM_WORLD);
  const meshing::Chords all = meshing::chords(*meshes.space()->coarse);
  std::vector<mesh::Cuts> cuts(5);
  for (std::size_t c = 0; c < 5; ++c)
    for (std::size_t d = 0; d < 2; ++d)
      if (all.of_cell[c][d] != all.of_cell[0][0] && all.of_cell[c][d] != all.of_cell[0][1]) cuts[c][d] = {0.5};
  meshes.cut({}, cuts);
  EXPECT_EQ(meshes.space()->global_cells, 9);
  meshes.refine({});
  EXPECT_EQ(meshes.space()->global_cells, 36);
}

}  // namespace
}  // namespace plastron::fem::cut_mesh_test
