// The nested meshes on 1, 2 and 3 ranks: counts and measures must not depend on their distribution.
#include <gtest/gtest.h>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/fem/triangle_sequence.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>

#include "fem/mesh_measure.hpp"

namespace plastron::fem {
namespace {

using std::numbers::pi;

struct Sample {
  std::string name;
  domain::Domain domain;
  double area;
  std::map<std::string, double> lengths;
  mesh::Shape shape = mesh::Shape::quadrilateral;

  mesh::CoarseMesh coarse() const { return domain::coarse_mesh(domain, shape); }
  MeshSequence meshes(int degree) const { return {coarse(), degree, MPI_COMM_WORLD}; }
  std::vector<int> degrees() const {
    return shape == mesh::Shape::triangle ? std::vector{1, 2} : std::vector{1, 2, 3, 4, 5};
  }
  int highest_degree() const { return degrees().back(); }
};

std::vector<Sample> samples() {
  return {{"one cell", domain::Rectangle{}, 1, {{"left", 1}, {"right", 1}, {"bottom", 1}, {"top", 1}}},
          {"rectangle",
           domain::Rectangle{.from = {-1, 0}, .to = {2, 1}, .cells = {3, 2}},
           3,
           {{"left", 1}, {"right", 1}, {"bottom", 3}, {"top", 3}}},
          {"disk", domain::Disk{.centre = {1, 2}, .radius = 0.5}, pi / 4, {{"rim", pi}}},
          {"annulus", domain::Annulus{.inner = 0.5, .outer = 1}, 0.75 * pi, {{"inner", pi}, {"outer", 2 * pi}}},
          {"quadrilateral",
           domain::Polygon{{{0, 0}, {0, 1}, {2, 2}, {1, 0}}},
           2,
           {{"edge1", 1}, {"edge2", std::sqrt(5.0)}, {"edge3", std::sqrt(5.0)}, {"edge4", 1}}},
          {"L",
           domain::Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
           3,
           {{"edge1", 2}, {"edge2", 1}, {"edge3", 1}, {"edge4", 1}, {"edge5", 1}, {"edge6", 2}}},
          {"clockwise cells",
           domain::MeshFile{PLASTRON_TESTS_DIR "/domain/data/clockwise-2.2.msh"},
           2.75,
           {{"edge", 3.5 + std::sqrt(1.25) + std::sqrt(0.8125) + std::sqrt(1.8125)}}},
          // "junction" lies inside, where two cells meet, and counts once.
          {"two regions",
           domain::MeshFile{PLASTRON_TESTS_DIR "/domain/data/two-regions-4.1.msh"},
           3,
           {{"clamped", 1}, {"junction", 1}, {"free", 1}, {"", 6}}}};
}

template <class Check>
void for_every_sample(const Check& check) {
  for (Sample& s : samples())
    for (const mesh::Shape shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
      SCOPED_TRACE(s.name + (shape == mesh::Shape::triangle ? " of triangles" : ""));
      s.shape = shape;
      check(s);
    }
}

double over_ranks(double value) { return algebra::sum_over_ranks(value, MPI_COMM_WORLD); }
std::int64_t over_ranks(std::int64_t value) { return algebra::sum_over_ranks(value, MPI_COMM_WORLD); }

struct Counts {
  mesh::Shape shape;
  std::int64_t vertices, edges, cells;
  Counts refined() const {
    if (shape == mesh::Shape::triangle) return {shape, vertices + edges, 2 * edges + 3 * cells, 4 * cells};
    return {shape, vertices + edges + cells, 2 * edges + 4 * cells, 4 * cells};
  }
  std::int64_t nodes(int k) const {
    const int inside = shape == mesh::Shape::triangle ? (k - 1) * (k - 2) / 2 : (k - 1) * (k - 1);
    return vertices + (k - 1) * edges + inside * cells;
  }
};

Counts counts_of(const mesh::CoarseMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  const int sides = mesh::corner_count(mesh.shape);
  for (const mesh::CoarseCell& cell : mesh.cells)
    for (int s = 0; s < sides; ++s) {
      const auto e = mesh::side_corners(mesh.shape, s);
      edges.insert(std::minmax(cell.vertices[e[0]], cell.vertices[e[1]]));
    }
  std::set<int> used;
  for (const mesh::CoarseCell& cell : mesh.cells) used.insert(cell.vertices.begin(), cell.vertices.begin() + sides);
  return {mesh.shape, static_cast<std::int64_t>(used.size()), static_cast<std::int64_t>(edges.size()),
          static_cast<std::int64_t>(mesh.cells.size())};
}

std::vector<Vector2d> nodes_of_cell(mesh::Shape shape, int degree) {
  if (shape == mesh::Shape::triangle) return mesh::lattice(shape, degree);
  std::vector<Vector2d> xi;
  const auto line = mesh::gauss_lobatto(degree + 1).points;
  for (const double t : line)
    for (const double s : line) xi.emplace_back(s, t);
  return xi;
}

/// Positions of all local nodes, given by owners to ghosts. Expects that all cells of this rank agree on them.
algebra::Vector node_positions(const Space& space) {
  algebra::Vector positions(space.layout, 2);
  std::vector<char> known(static_cast<std::size_t>(space.layout->local_size()));
  const auto xi = nodes_of_cell(space.shape(), space.degree);
  for (const bool checking : {false, true}) {
    for (std::size_t c = 0; c < space.cells.size(); ++c)
      for (std::size_t i = 0; i < xi.size(); ++i) {
        const auto node = static_cast<std::size_t>(space.nodes(c)[i]);
        const Vector2d p = position(space, space.cells[c], xi[i]);
        if (!checking)
          Eigen::Map<Vector2d>(positions.local().data() + 2 * node) = p;
        else
          EXPECT_LT((Eigen::Map<const Vector2d>(positions.local().data() + 2 * node) - p).norm(), 1e-13);
        known[node] = 1;
      }
    positions.update_ghosts();
  }
  for (const char k : known) EXPECT_TRUE(k);
  return positions;
}

TEST(MeshSequence, has_as_many_cells_and_nodes_as_euler_counts) {
  for_every_sample([](const Sample& s) {
    const mesh::CoarseMesh coarse = s.coarse();
    for (const int k : {1, 2, s.highest_degree()}) {
      MeshSequence meshes(coarse, k, MPI_COMM_WORLD);
      Counts counts = counts_of(coarse);
      for (int level = 0; level < 3; ++level) {
        const Space& space = *meshes.space();
        EXPECT_EQ(space.global_cells, counts.cells);
        EXPECT_EQ(over_ranks(static_cast<std::int64_t>(space.owned_cells)), counts.cells);
        EXPECT_EQ(space.layout->global_size, counts.nodes(k));
        EXPECT_EQ(over_ranks(static_cast<std::int64_t>(space.layout->owned)), counts.nodes(k));
        counts = counts.refined();
        meshes.refine({});
      }
    }
  });
}

TEST(MeshSequence, covers_the_domain_on_every_level) {
  for_every_sample([](const Sample& s) {
    MeshSequence meshes = s.meshes(1);
    for (int level = 0; level < 3; ++level) {
      EXPECT_NEAR(over_ranks(owned_area(*meshes.space())), s.area, 1e-12);
      meshes.refine({});
    }
  });
}

TEST(MeshSequence, names_boundary_faces_after_their_boundary) {
  for_every_sample([](const Sample& s) {
    MeshSequence meshes = s.meshes(2);
    for (int level = 0; level < 3; ++level) {
      auto lengths = owned_boundary_lengths(*meshes.space());
      for (const auto& [name, length] : s.lengths) EXPECT_NEAR(over_ranks(lengths[name]), length, 1e-11) << name;
      for (const auto& [name, length] : lengths) EXPECT_TRUE(s.lengths.contains(name) || length == 0) << name;
      meshes.refine({});
    }
  });
}

TEST(MeshSequence, gives_every_node_one_position_in_all_its_cells) {
  for_every_sample([](const Sample& s) {
    for (const int k : s.degrees()) {
      MeshSequence meshes = s.meshes(k);
      for (int level = 0; level < 3; ++level) {
        const algebra::Vector positions = node_positions(*meshes.space());  // expects that all cells agree
        EXPECT_EQ(positions.owned().size(), 2 * static_cast<std::size_t>(meshes.space()->layout->owned));
        meshes.refine({});
      }
    }
  });
}

TEST(MeshSequence, gives_different_nodes_different_positions) {
  for_every_sample([](const Sample& s) {
    MeshSequence meshes = s.meshes(std::min(3, s.highest_degree()));
    meshes.refine({});
    const algebra::Vector positions = node_positions(*meshes.space());
    std::set<std::pair<std::int64_t, std::int64_t>> seen;
    for (std::size_t i = 0; i < positions.local().size(); i += 2)
      seen.emplace(std::llround(positions.local()[i] * 1e7), std::llround(positions.local()[i + 1] * 1e7));
    EXPECT_EQ(2 * seen.size(), positions.local().size());
  });
}

TEST(MeshSequence, lists_owned_cells_first_and_orients_all_cells_alike) {
  for_every_sample([](const Sample& s) {
    MeshSequence meshes = s.meshes(2);
    meshes.refine({});
    const Space& space = *meshes.space();
    ASSERT_LE(space.owned_cells, space.cells.size());
    ASSERT_EQ(space.connectivity.elements(), space.cells.size());
    for (const Cell& cell : space.cells) {
      EXPECT_EQ(std::abs(cell.size), 0.5);
      const geometry::PlaneJet f = space.coarse->cells[static_cast<std::size_t>(cell.coarse)].map(
          cell.corner + cell.size * mesh::centre(s.shape));
      EXPECT_NE(f.d[0][0] * f.d[1][1] - f.d[0][1] * f.d[1][0], 0);
      EXPECT_GT(f.d[0][0] * f.d[1][1] - f.d[0][1] * f.d[1][0], 0);  // every a_3 on the same side
    }
  });
}

/// A polynomial of degree k in x and in y, and of degree k altogether for triangles.
double polynomial(mesh::Shape shape, int k, double x, double y) {
  if (shape == mesh::Shape::triangle) return std::pow(x - 0.3, k) + std::pow(y + 0.2 * x, k) - 2 * x - y + 1;
  return std::pow(x - 0.3, k) * (1 + std::pow(y + 0.2, k)) - 2 * x * y + 1;
}

void expect_polynomials_carried_exactly(const mesh::CoarseMesh& coarse, int k) {
  const mesh::Shape shape = coarse.shape;
  MeshSequence meshes(coarse, k, MPI_COMM_WORLD);
  std::vector<algebra::Vector> fields;
  fields.emplace_back(meshes.space()->layout, 1);
  fields.emplace_back(meshes.space()->layout, 3);
  for (int level = 0; level < 3; ++level) {
    const algebra::Vector x = node_positions(*meshes.space());
    for (std::size_t i = 0; i < x.local().size() / 2; ++i) {
      const double exact = polynomial(shape, k, x.local()[2 * i], x.local()[2 * i + 1]);
      for (int field = 0; field < 2; ++field)
        for (std::size_t c = 0; c < (field == 0 ? 1u : 3u); ++c) {
          double& value = fields[static_cast<std::size_t>(field)].local()[(field == 0 ? 1u : 3u) * i + c];
          const double expected = exact * (1.0 + static_cast<double>(c)) + field;
          if (level == 0) value = expected;
          EXPECT_NEAR(value, expected, 1e-12);
        }
    }
    meshes.refine(fields);
    EXPECT_EQ(fields[0].layout(), meshes.space()->layout);
    EXPECT_EQ(fields[1].block(), 3);
  }
}

TEST(Refinement, carries_polynomials_of_the_elements_degree_exactly) {
  const domain::Rectangle domain{.to = {1.5, 1}, .cells = {3, 2}};
  for (int k = 1; k <= 5; ++k)
    expect_polynomials_carried_exactly(domain::coarse_mesh(domain, mesh::Shape::quadrilateral), k);
  for (int k = 1; k <= 2; ++k)
    expect_polynomials_carried_exactly(domain::coarse_mesh(domain, mesh::Shape::triangle), k);
}

// Then ranks have no cell first and later receive some whose parents belong to another rank.
TEST(Refinement, carries_fields_to_ranks_that_had_no_triangle) {
  mesh::CoarseMesh one = domain::coarse_mesh(domain::Rectangle{}, mesh::Shape::triangle);
  one.cells.resize(1);
  const auto& of_cell = one.cells[0].vertices;  // three and an unused one
  std::erase_if(one.edges, [&](const mesh::BoundaryEdge& edge) {
    return std::ranges::any_of(edge.vertices, [&](int v) {
      return std::find(of_cell.begin(), of_cell.begin() + 3, v) == of_cell.begin() + 3;
    });
  });
  for (int k = 1; k <= 2; ++k) expect_polynomials_carried_exactly(one, k);
}

// Any field, not only a polynomial: the coarse function itself is in the finer space.
TEST(Refinement, of_triangles_keeps_the_function) {
  for (const int k : {1, 2}) {
    MeshSequence meshes(domain::coarse_mesh(domain::Disk{}, mesh::Shape::triangle), k, MPI_COMM_WORLD);
    const auto coarse = meshes.space();
    std::vector<algebra::Vector> fields;
    fields.emplace_back(coarse->layout, 1);
    for (algebra::LocalIndex i = 0; i < coarse->layout->local_size(); ++i)
      fields[0].local()[static_cast<std::size_t>(i)] = std::sin(7.0 * static_cast<double>(coarse->layout->global(i)));
    const algebra::Vector before = fields[0];
    meshes.refine(fields);
    const Space& fine = *meshes.space();
    std::int64_t compared = 0;
    for (std::size_t c = 0; c < fine.cells.size(); ++c) {
      const Vector2d xi = fine.cells[c].corner + fine.cells[c].size * Vector2d(0.2, 0.3);
      const auto parent =
          std::ranges::find(coarse->cells, fine.cells[c].coarse, [](const Cell& cell) { return cell.coarse; });
      if (parent == coarse->cells.end()) continue;  // on another rank
      ++compared;
      const auto value = [&](const Space& space, const algebra::Vector& field, std::size_t cell, const Vector2d& at) {
        const auto basis = mesh::lattice_values(mesh::Shape::triangle, k, at).value;
        double sum = 0;
        for (std::size_t i = 0; i < space.nodes(cell).size(); ++i)
          sum += basis[static_cast<Eigen::Index>(i)] * field.local()[static_cast<std::size_t>(space.nodes(cell)[i])];
        return sum;
      };
      EXPECT_NEAR(value(fine, fields[0], c, {0.2, 0.3}),
                  value(*coarse, before, static_cast<std::size_t>(parent - coarse->cells.begin()), xi), 1e-14);
    }
    EXPECT_GE(over_ranks(compared), fine.global_cells / 2);
  }
}

/// Hash of the whole mesh: global node numbers of every cell, identified by its place.
std::map<std::array<std::int64_t, 4>, std::vector<std::int64_t>> nodes_by_place(const Space& space) {
  std::map<std::array<std::int64_t, 4>, std::vector<std::int64_t>> all;
  for (std::size_t c = 0; c < space.cells.size(); ++c) {
    const Cell& cell = space.cells[c];
    auto& nodes = all[{cell.coarse, std::llround(cell.corner[0] * 1024), std::llround(cell.corner[1] * 1024),
                       std::llround(cell.size * 1024)}];
    for (const auto node : space.nodes(c)) nodes.push_back(space.layout->global(node));
  }
  return all;
}

TEST(Triangles, are_numbered_the_same_on_any_number_of_ranks) {
  for (const int k : {1, 2}) {
    const mesh::CoarseMesh coarse = domain::coarse_mesh(domain::Disk{}, mesh::Shape::triangle);
    MeshSequence together(coarse, k, MPI_COMM_WORLD), alone(coarse, k, MPI_COMM_SELF);
    for (int level = 0; level < 3; ++level) {
      const auto whole = nodes_by_place(*alone.space()), here = nodes_by_place(*together.space());
      for (const auto& [place, nodes] : here) EXPECT_EQ(nodes, whole.at(place));
      together.refine({});
      alone.refine({});
    }
  }
}

// The supports of a node need every boundary face at it, the matrix needs every element.
TEST(Triangles, round_an_owned_node_are_all_local) {
  for_every_sample([](const Sample& s) {
    if (s.shape == mesh::Shape::quadrilateral) return;
    MeshSequence together = s.meshes(2), alone(s.coarse(), 2, MPI_COMM_SELF);
    together.refine({});
    alone.refine({});
    const auto cells_at = [](const Space& space) {
      std::map<std::int64_t, int> count;
      for (std::size_t c = 0; c < space.cells.size(); ++c)
        for (const auto node : space.nodes(c)) ++count[space.layout->global(node)];
      return count;
    };
    auto whole = cells_at(*alone.space()), here = cells_at(*together.space());
    const algebra::Layout& layout = *together.space()->layout;
    for (algebra::LocalIndex i = 0; i < layout.owned; ++i) EXPECT_EQ(here[layout.global(i)], whole[layout.global(i)]);
  });
}

TEST(Triangles, beyond_32_bit_numbers_are_refused) {
  constexpr std::int64_t cells = std::int64_t{1} << 28, vertices = cells / 2, edges = cells + cells / 2;
  EXPECT_NO_THROW(check_refinable(vertices, edges, cells));
  EXPECT_THROW(check_refinable(2 * vertices, 2 * edges, 2 * cells), mesh::DomainError);
}

TEST(Triangles, of_degree_three_are_refused) {
  EXPECT_THROW(MeshSequence(domain::coarse_mesh(domain::Disk{}, mesh::Shape::triangle), 3, MPI_COMM_WORLD),
               mesh::DomainError);
}

TEST(Refinement, leaves_spaces_that_are_still_held_alone) {
  MeshSequence meshes(domain::coarse_mesh(domain::Disk{}, mesh::Shape::quadrilateral), 2, MPI_COMM_WORLD);
  const auto before = meshes.space();
  const auto cells = before->cells.size();
  meshes.refine({});
  EXPECT_EQ(before->cells.size(), cells);
  EXPECT_NE(before, meshes.space());
}

TEST(Point, is_found_in_the_cell_that_holds_it) {
  for_every_sample([](const Sample& s) {
    MeshSequence meshes = s.meshes(2);
    meshes.refine({});
    meshes.refine({});
    const Space& space = *meshes.space();
    const mesh::CoarseMesh& coarse = *space.coarse;
    for (const mesh::CoarseCell& cell : coarse.cells)
      for (const Vector2d& xi :
           {Vector2d(0.3, 0.6), Vector2d(0.5, 0.5), Vector2d(0, 0), Vector2d(1, 0.25), Vector2d(0.9, 1)}) {
        if (!mesh::holds(s.shape, xi, 0)) continue;
        const Vector2d point = cell.map(xi).value;
        const auto location = locate(coarse, point);
        ASSERT_TRUE(location) << point.transpose();
        EXPECT_LT((coarse.cells[static_cast<std::size_t>(location->coarse)].map(location->xi).value - point).norm(),
                  1e-8);
        std::int64_t holders = 0;
        for (std::size_t c = 0; c < space.owned_cells; ++c)
          if (const auto local = local_coordinates(s.shape, space.cells[c], *location)) {
            ++holders;
            EXPECT_LT((position(space, space.cells[c], *local) - point).norm(), 1e-8);
          }
        EXPECT_GE(over_ranks(holders), 1);
      }
  });
}

TEST(Point, outside_of_the_domain_is_nowhere) {
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Rectangle{}, mesh::Shape::quadrilateral), {1.001, 0.5}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Disk{}, mesh::Shape::quadrilateral), {0.8, 0.8}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Disk{}, mesh::Shape::quadrilateral), {0, 1.00001}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Annulus{}, mesh::Shape::quadrilateral), {0, 0}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Annulus{}, mesh::Shape::quadrilateral), {0.49, 0}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
                                          mesh::Shape::quadrilateral),
                      {1.5, 1.5}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Disk{}, mesh::Shape::quadrilateral), {1e6, -1e6}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Disk{}, mesh::Shape::triangle), {0.8, 0.8}));
  EXPECT_FALSE(locate(domain::coarse_mesh(domain::Annulus{}, mesh::Shape::triangle), {0, 0}));
}

TEST(Point, on_the_boundary_is_inside) {
  for (int k = 0; k < 16; ++k) {
    const Vector2d direction(std::cos(k * pi / 8 + 0.1), std::sin(k * pi / 8 + 0.1));
    EXPECT_TRUE(locate(domain::coarse_mesh(domain::Disk{}, mesh::Shape::quadrilateral), direction));
    EXPECT_TRUE(locate(domain::coarse_mesh(domain::Disk{}, mesh::Shape::triangle), direction));
    EXPECT_TRUE(locate(domain::coarse_mesh(domain::Annulus{}, mesh::Shape::quadrilateral), direction));
    EXPECT_TRUE(locate(domain::coarse_mesh(domain::Annulus{}, mesh::Shape::quadrilateral), direction / 2));
  }
}

}  // namespace
}  // namespace plastron::fem
