// Orientation, kinds of edges, sheets and directors of surface meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/topology/surface_topology.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "topology/space_meshes.hpp"

namespace plastron::topology::space_meshes {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr double degree = pi / 180;

std::size_t number(const SurfaceSummary& summary, EdgeKind kind) {
  return summary.edges[static_cast<std::size_t>(kind)].number;
}
std::size_t number(const SurfaceTopology& t, EdgeKind kind) { return number(summary_of(t), kind); }

std::string refusal(const SpaceMesh& mesh, const SurfaceOptions& options = {}) {
  try {
    surface_topology(mesh, options);
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

/// a_1 x a_2 of the triangle of a cell's first three corners.
Vector3d flat_normal(const SurfaceTopology& t, std::size_t c) {
  const auto n = corner_nodes(t.mesh.shape, t.mesh.cells[c]);
  return (t.mesh.nodes[n[1]] - t.mesh.nodes[n[0]]).cross(t.mesh.nodes[n[2]] - t.mesh.nodes[n[0]]);
}

/// Checks the conditions of p4est: cells have different vertices; an edge has one or two cells, which run along it in opposite
/// directions; it has two cells if and only if they share their director nodes along it.
void expect_manifold(const SurfaceTopology& t) {
  std::map<std::array<int, 2>, std::vector<mesh::MeshEdge>> cells_at;
  for (std::size_t c = 0; c < t.mesh.cells.size(); ++c) {
    auto vertices = t.cell_vertices[c];
    for (int side = 0; side < mesh::corner_count(t.mesh.shape); ++side) {
      const auto [from, to] = mesh::anticlockwise_corners(t.mesh.shape, side);
      const int a = vertices[from], b = vertices[to];
      cells_at[{std::min(a, b), std::max(a, b)}].push_back({{a, b}, c, side, a < b});
    }
    std::ranges::sort(vertices);
    EXPECT_EQ(std::ranges::adjacent_find(vertices), vertices.end());
  }
  std::size_t joined = 0;
  for (const auto& [ends, cells] : cells_at) {
    ASSERT_LE(cells.size(), 2u);
    if (cells.size() < 2) continue;
    ++joined;
    EXPECT_NE(cells[0].is_forward, cells[1].is_forward);
    std::vector<std::int32_t> nodes[2];
    for (int i : {0, 1}) {
      const SurfaceCell& cell = t.mesh.cells[cells[i].cell];
      for (const int p : mesh::side_nodes(t.mesh.shape, cell.order, cells[i].side))
        nodes[i].push_back(t.cell_director_nodes[cells[i].cell][p]);
      std::ranges::sort(nodes[i]);
    }
    EXPECT_EQ(nodes[0], nodes[1]);
  }
  // Two cells of a lone branch may be joined, too.
  EXPECT_GE(joined, number(t, EdgeKind::smooth));
  EXPECT_LE(joined, number(t, EdgeKind::smooth) + 2 * number(t, EdgeKind::branch));
  for (std::size_t c = 0; c < t.mesh.cells.size(); ++c)
    for (std::size_t n = 0; n < t.mesh.cells[c].nodes.size(); ++n)
      EXPECT_EQ(t.director_nodes[t.cell_director_nodes[c][n]].node, t.mesh.cells[c].nodes[n]);
}

TEST(Cube, has_twelve_folds_six_sheets_and_outward_normals_whatever_cells_were_turned) {
  for (const mesh::Shape shape : shapes)
    for (const int cells : {1, 3})
      for (unsigned seed = 0; seed < 5; ++seed) {
        SpaceMesh mesh = cube(shape, cells);
        turn_some(mesh, seed);
        const SurfaceTopology t = surface_topology(mesh, {});
        expect_manifold(t);
        const SurfaceSummary s = summary_of(t);
        EXPECT_EQ(number(s, EdgeKind::fold), 12u * cells);
        EXPECT_EQ(number(s, EdgeKind::border), 0u);
        EXPECT_EQ(t.sheet_count, 6);
        EXPECT_TRUE(s.is_closed);
        EXPECT_NEAR(s.volume, 1, 1e-14);
        EXPECT_NEAR(s.area, 6, 1e-13);
        EXPECT_NEAR(s.edges[static_cast<int>(EdgeKind::fold)].largest_angle, pi / 2, 1e-12);
        EXPECT_EQ(t.vertex_director_nodes.size(), 6u * (cells + 1) * (cells + 1));
        EXPECT_EQ(t.components[0].sign, SignRule::outward);
        for (std::size_t c = 0; c < t.mesh.cells.size(); ++c) {
          EXPECT_GT(flat_normal(t, c).dot(t.mesh.nodes[t.mesh.cells[c].nodes[0]]), 0);
          for (const std::int32_t d : t.cell_director_nodes[c])
            EXPECT_NEAR(t.director_nodes[d].director.dot(flat_normal(t, c).normalized()), 1, 1e-14);
        }
      }
}

TEST(Cube, reports_the_cells_that_it_turned) {
  SpaceMesh mesh = cube(mesh::Shape::quadrilateral, 3);
  for (const int c : {0, 7, 30}) mesh.cells[c] = turned(mesh.shape, mesh.cells[c]);
  const SurfaceTopology t = surface_topology(mesh, {});
  EXPECT_EQ(summary_of(t).turned, 3u);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) EXPECT_EQ(t.is_turned[c], c == 0 || c == 7 || c == 30);
}

TEST(Sphere, is_one_closed_sheet_whose_directors_converge_with_the_order_of_the_cells) {
  for (const mesh::Shape shape : shapes)
    for (const int order : {1, 2, 3, 4}) {
      double errors[2];
      for (const int fineness : {0, 1}) {
        SpaceMesh mesh = sphere(shape, 8 << fineness, order);
        turn_some(mesh, 3);
        const SurfaceTopology t = surface_topology(mesh, {});
        expect_manifold(t);
        const SurfaceSummary s = summary_of(t);
        EXPECT_TRUE(s.is_closed);
        EXPECT_EQ(number(s, EdgeKind::smooth), t.edges.size());
        EXPECT_EQ(t.sheet_count, 1);
        EXPECT_EQ(t.director_nodes.size(), mesh.nodes.size());
        double& sum = errors[fineness] = 0;
        for (const DirectorNode& n : t.director_nodes) sum += (n.director - t.mesh.nodes[n.node]).norm();
        sum /= static_cast<double>(t.director_nodes.size());
        const double h = 0.25 / (1 << fineness);
        EXPECT_NEAR(s.volume, 4 * pi / 3, 3 * std::pow(h, order + 1));
        EXPECT_NEAR(s.area, 4 * pi, 3 * std::pow(h, order + 1));
      }
      EXPECT_LT(errors[1], 1.25 * std::pow(0.5, order) * errors[0]) << order;
    }
}

TEST(Torus, is_closed_and_its_volume_converges) {
  for (const mesh::Shape shape : shapes) {
    const SurfaceTopology coarse = surface_topology(torus(shape, {4, 3, 4}), {.smooth_angle = pi / 2});
    expect_manifold(coarse);
    EXPECT_TRUE(summary_of(coarse).is_closed);
    EXPECT_EQ(coarse.sheet_count, 1);
    const SurfaceTopology fine = surface_topology(torus(shape, {16, 12, 4}), {});
    EXPECT_NEAR(summary_of(fine).volume, 2 * pi * pi * 3, 1e-3);
    EXPECT_NEAR(summary_of(fine).area, 4 * pi * pi * 3, 1e-3);
    // Euler's number of the torus: vertices - edges + cells = 0.
    EXPECT_EQ(fine.vertex_director_nodes.size() + fine.mesh.cells.size(), fine.edges.size());
  }
}

TEST(Torus, of_order_one_with_four_times_three_cells_is_twelve_sheets_and_still_oriented) {
  const SurfaceTopology t =
      surface_topology(torus(mesh::Shape::quadrilateral, {4, 3, 1}), {.smooth_angle = 20 * degree});
  expect_manifold(t);
  EXPECT_EQ(number(t, EdgeKind::fold), 24u);
  EXPECT_EQ(t.sheet_count, 12);
  EXPECT_GT(summary_of(t).volume, 0);
}

TEST(TJoint, has_one_branch_line_and_three_sheets) {
  for (const mesh::Shape shape : shapes)
    for (const int order : {1, 2}) {
      const SurfaceTopology t = surface_topology(star(shape, 3, order, {0, pi / 2, pi}), {});
      expect_manifold(t);
      EXPECT_EQ(number(t, EdgeKind::branch), 3u);
      EXPECT_EQ(number(t, EdgeKind::fold), 0u);
      EXPECT_EQ(t.sheet_count, 3);
      EXPECT_EQ(t.components.size(), 3u);
      EXPECT_EQ(t.part_count, 1);
      for (const SurfaceComponent& c : t.components) EXPECT_EQ(c.sign, SignRule::file);
      EXPECT_EQ(t.director_nodes.size(), 3u * (3 * order + 1) * (3 * order + 1));
    }
}

TEST(Upper, decides_the_side_of_each_component) {
  SpaceMesh mesh = star(mesh::Shape::quadrilateral, 3, 1, {0, pi / 2, pi});
  turn_some(mesh, 1);
  for (const double sign : {-1.0, 1.0}) {
    const SurfaceTopology t = surface_topology(mesh, {.upper = Vector3d(0.1, 0, sign)});
    for (std::size_t c = 0; c < 27; ++c) {
      const bool is_upright = c >= 9 && c < 18;
      EXPECT_GT(is_upright ? flat_normal(t, c)[0] : sign * flat_normal(t, c)[2], 0);
    }
  }
  const SurfaceTopology inward =
      surface_topology(tube(mesh::Shape::quadrilateral, {12, 2, 1}), {.upper = Vector3d(0, 0, 1)});
  EXPECT_EQ(inward.components[0].sign, SignRule::file) << "the mean normal of a tube is zero";
}

TEST(Orientation, of_an_open_surface_is_that_of_the_larger_area_of_the_file) {
  SpaceMesh mesh{.nodes = {}, .cells = {}};
  add_grid({5, 2, 1}, plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
  for (const int c : {1, 3, 4, 9}) mesh.cells[c] = turned(mesh.shape, mesh.cells[c]);
  EXPECT_EQ(summary_of(surface_topology(mesh, {})).turned, 4u);
  for (SurfaceCell& cell : mesh.cells) cell = turned(mesh.shape, cell);
  const SurfaceTopology t = surface_topology(mesh, {});
  EXPECT_EQ(summary_of(t).turned, 4u);
  for (std::size_t c = 0; c < 10; ++c) EXPECT_LT(flat_normal(t, c)[2], 0);
}

TEST(NestedSpheres, are_two_components_that_both_point_outwards) {
  SpaceMesh mesh = sphere(mesh::Shape::quadrilateral, 4, 2);
  const SpaceMesh inner = mesh;
  const auto first = static_cast<std::int32_t>(mesh.nodes.size());
  for (const Vector3d& x : inner.nodes) mesh.nodes.push_back(x / 2);
  for (SurfaceCell cell : inner.cells) {
    for (std::int32_t& n : cell.nodes) n += first;
    mesh.cells.push_back(turned(mesh.shape, cell));
  }
  const SurfaceTopology t = surface_topology(mesh, {});
  EXPECT_EQ(t.part_count, 2);
  ASSERT_EQ(t.components.size(), 2u);
  EXPECT_NEAR(t.components[1].volume, t.components[0].volume / 8, 1e-12);
  EXPECT_EQ(t.components[0].turned, 0u);
  EXPECT_EQ(t.components[1].turned, inner.cells.size());
}

TEST(MoebiusStrip, is_refused_and_a_full_turn_is_not) {
  for (const mesh::Shape shape : shapes) {
    EXPECT_THAT(refusal(twisted_strip(shape, {24, 2, 1}, 1)), AllOf(HasSubstr("one side only"), HasSubstr("(")));
    EXPECT_THAT(refusal(twisted_strip(shape, {8, 1, 3}, 3)), HasSubstr("one side only"));
    const SurfaceTopology t = surface_topology(twisted_strip(shape, {24, 2, 1}, 2), {});
    expect_manifold(t);
  }
}

TEST(Tube, has_two_borders_and_no_fold) {
  for (const mesh::Shape shape : shapes)
    for (const int order : {1, 2}) {
      SpaceMesh mesh = tube(shape, {16, 2, order});
      turn_some(mesh, 7);
      const SurfaceTopology t = surface_topology(mesh, {});
      expect_manifold(t);
      EXPECT_EQ(number(t, EdgeKind::border), 32u);
      EXPECT_EQ(number(t, EdgeKind::fold), 0u);
      EXPECT_EQ(t.sheet_count, 1);
      EXPECT_FALSE(summary_of(t).is_closed);
      EXPECT_EQ(summary_of(t).volume, 0);
    }
}

TEST(Tube, of_three_elements_is_accepted_and_of_one_or_two_is_refused_with_the_remedy) {
  expect_manifold(surface_topology(tube(mesh::Shape::quadrilateral, {3, 1, 4}), {}));
  EXPECT_THAT(refusal(tube(mesh::Shape::quadrilateral, {2, 1, 4})),
              AllOf(HasSubstr("same corners"), HasSubstr("divide")));
  // merge_nodes() makes no cell of which two nodes are equal, so the seam is closed here.
  SpaceMesh mesh{.nodes = {}, .cells = {}};
  add_grid(
      {1, 1, 4}, [](double s, double t) { return Vector3d(std::cos(2 * pi * s), std::sin(2 * pi * s), t); }, mesh);
  for (int row = 0; row < 5; ++row) mesh.cells[0].nodes[5 * row + 4] = mesh.cells[0].nodes[5 * row];
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("closes on itself"), HasSubstr("divide")));
}

TEST(LPlate, is_folded_along_one_line_at_every_angle_above_the_limit) {
  for (const mesh::Shape shape : shapes)
    for (const int order : {1, 2})
      for (const double angle : {4.0, 6.0, 19.0, 29.0, 31.0, 90.0, 150.0, 178.0}) {
        const SurfaceTopology t = surface_topology(star(shape, 2, order, {0, pi - angle * degree}), {});
        expect_manifold(t);
        const double limit = order == 1 ? 30 : 10;
        const bool is_fold = angle > limit;
        EXPECT_EQ(number(t, EdgeKind::fold), is_fold ? 2u : 0u);
        EXPECT_EQ(t.sheet_count, is_fold ? 2 : 1);
        EXPECT_EQ(t.components.size(), 1u);
        const SurfaceEdge* edge = find_edge(t, {t.edges[0].ends});
        EXPECT_EQ(edge, &t.edges[0]);
        EXPECT_NEAR(std::ranges::max(t.edges, {}, &SurfaceEdge::angle).angle, angle * degree, 1e-9);
        EXPECT_EQ(t.edges_near_limit.empty(), angle > 2 * limit || angle < limit / 2) << angle;
      }
}

TEST(Fold, by_name_is_a_fold_at_any_angle) {
  const SpaceMesh mesh = star(mesh::Shape::quadrilateral, 2, 2, {0, pi});
  const SurfaceTopology plane = surface_topology(mesh, {});
  EXPECT_EQ(plane.sheet_count, 1);
  SurfaceOptions options;
  for (const SurfaceEdge& edge : plane.edges)
    if (std::abs(mesh.nodes[edge.ends[0]][0]) + std::abs(mesh.nodes[edge.ends[1]][0]) < 1e-9)
      options.folds.insert(edge.ends);
  ASSERT_EQ(options.folds.size(), 2u);
  const SurfaceTopology t = surface_topology(mesh, options);
  EXPECT_EQ(number(t, EdgeKind::fold), 2u);
  EXPECT_EQ(t.sheet_count, 2);
}

TEST(FoldBack, is_refused_with_its_place) {
  EXPECT_THAT(refusal(star(mesh::Shape::quadrilateral, 1, 1, {0, 0.5 * degree})),
              AllOf(HasSubstr("fold back"), HasSubstr("element 1"), HasSubstr("element 2"), HasSubstr("(0, 0, 0)"),
                    HasSubstr("179.5 degrees")));
}

/// A sheet over [-1, 1]^2, flat for x < 0; for x > 0 a roof rises, whose ridge is y = 0.
SpaceMesh sheet_with_crease(mesh::Shape shape, int cells) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  add_grid(
      {cells, cells, 1},
      [](double s, double t) {
        const double x = 2 * s - 1, y = 2 * t - 1;
        return Vector3d(x, y, 1.2 * std::pow(std::max(x, 0.0), 2) * (1 - std::abs(y)));
      },
      mesh);
  return mesh;
}

TEST(Crease, that_ends_inside_of_a_sheet_has_one_node_at_its_end_and_two_along_it) {
  const SpaceMesh mesh = sheet_with_crease(mesh::Shape::quadrilateral, 8);
  const SurfaceTopology t = surface_topology(mesh, {.smooth_angle = 30 * degree});
  expect_manifold(t);
  ASSERT_EQ(number(t, EdgeKind::fold), 2u);
  EXPECT_EQ(t.sheet_count, 1);
  EXPECT_EQ(t.director_nodes.size(), mesh.nodes.size() + 2);
}

TEST(Crease, of_one_edge_cannot_be_cut_and_is_smooth) {
  const SpaceMesh mesh = star(mesh::Shape::quadrilateral, 4, 2, {0, pi});
  const SurfaceTopology plane = surface_topology(mesh, {});
  for (const SurfaceEdge& edge : plane.edges)
    if ((mesh.nodes[edge.ends[0]] + mesh.nodes[edge.ends[1]] - Vector3d(0, 0.75, 0)).norm() < 1e-9) {
      const SurfaceTopology t = surface_topology(mesh, {.folds = {edge.ends}});
      expect_manifold(t);
      EXPECT_EQ(summary_of(t).lone_folds, 1u);
      EXPECT_TRUE(find_edge(t, edge.ends)->is_lone_fold);
      EXPECT_EQ(t.director_nodes.size(), mesh.nodes.size());
    }
}

TEST(Fin, of_one_element_on_a_plate_is_cut_off_the_plate) {
  for (const int order : {1, 2}) {
    SpaceMesh mesh{.nodes = {}, .cells = {}};
    add_grid({2, 3, order}, plate({-1, -1, 0}, {2, 0, 0}, {0, 3, 0}), mesh);
    add_grid({1, 1, order}, plate({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), mesh);
    mesh = glued(std::move(mesh));
    const SurfaceTopology t = surface_topology(mesh, {});
    EXPECT_EQ(t.director_nodes.size(), mesh.nodes.size() + order + 1);
    EXPECT_EQ(t.sheet_count, 2);
    std::size_t branches = 0;
    for (const SurfaceEdge& edge : t.edges) branches += edge.kind == EdgeKind::branch;
    EXPECT_EQ(branches, 1u);
  }
}

TEST(Box, with_a_wall_inside_has_two_open_halves_and_the_wall) {
  SpaceMesh mesh{.nodes = {}, .cells = {}};
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
  for (const double at : {0.0, 1.0, 2.0}) add_grid({2, 2, 2}, plate(at * x, y, z), mesh);
  for (const double at : {0.0, 1.0})
    for (const Vector3d& corner : {o, z}) add_grid({2, 2, 2}, plate(at * x + corner, x, y), mesh);
  for (const double at : {0.0, 1.0})
    for (const Vector3d& corner : {o, y}) add_grid({2, 2, 2}, plate(at * x + corner, z, x), mesh);
  const SurfaceTopology t = surface_topology(glued(std::move(mesh)), {});
  expect_manifold(t);
  EXPECT_EQ(t.sheet_count, 11);
  EXPECT_EQ(t.components.size(), 3u);
  EXPECT_EQ(t.part_count, 1);
  EXPECT_EQ(number(t, EdgeKind::branch), 8u);
  EXPECT_EQ(number(t, EdgeKind::border), 0u);
  EXPECT_FALSE(summary_of(t).is_closed);
}

TEST(BowTie, is_refused) {
  for (const mesh::Shape shape : shapes) {
    SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
    add_grid({2, 2, 1}, plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
    add_grid({2, 2, 1}, plate({1, 1, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
    EXPECT_THAT(refusal(glued(mesh)), AllOf(HasSubstr("only at a point"), HasSubstr("(1, 1, 0)")));
  }
}

TEST(Neighbours, with_differently_curved_sides_are_refused) {
  SpaceMesh mesh = star(mesh::Shape::quadrilateral, 1, 2, {0, pi});
  const std::int32_t middle = mesh.cells[1].nodes[3];
  ASSERT_LT(mesh.nodes[middle].cwiseAbs().maxCoeff(), 0.6);
  mesh.nodes.push_back(mesh.nodes[middle] + Vector3d(0.01, 0, 0));
  mesh.cells[1].nodes[3] = static_cast<std::int32_t>(mesh.nodes.size() - 1);
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("curved differently"), HasSubstr("element 1"), HasSubstr("element 2")));
}

TEST(Node, that_is_a_corner_of_one_cell_and_inside_of_anothers_side_is_refused) {
  SpaceMesh mesh{.nodes = {}, .cells = {}};
  add_grid({1, 1, 2}, plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
  add_grid({2, 2, 2}, plate({1, 0, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
  EXPECT_THAT(refusal(glued(mesh)), AllOf(HasSubstr("whole sides"), HasSubstr("element 1"), HasSubstr("(1, 0.5, 0)")));
}

TEST(DegenerateCell, is_refused_with_element_and_place) {
  SpaceMesh mesh{.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.5, 0}},
                 .cells = {{.nodes = {0, 1, 2, 3}, .tag = 5}}};
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("element 5"), HasSubstr("degenerate"), HasSubstr("(0.5, 0.5, 0)")));
}

TEST(NormalsOfTheFile, replace_the_mean_in_its_direction) {
  SpaceMesh mesh = sphere(mesh::Shape::quadrilateral, 4, 1);
  mesh.normals.resize(mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); n += 2) mesh.normals[n] = (n % 4 == 0 ? -3 : 1) * mesh.nodes[n];
  const SurfaceTopology t = surface_topology(mesh, {});
  for (const DirectorNode& n : t.director_nodes)
    EXPECT_LT(n.node % 2 == 0 ? (n.director - t.mesh.nodes[n.node]).norm() : 0.0, 1e-15);
  const Vector3d x = mesh.nodes[4];
  mesh.normals[4] = x.unitOrthogonal();
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("normal given"), HasSubstr("at most 60"), HasSubstr(place_of(x))));
  mesh.normals[4] = Vector3d::Zero();
  EXPECT_THAT(refusal(mesh), HasSubstr("no direction"));
}

TEST(NormalsOfTheFile, at_a_fold_count_for_the_sheet_that_they_fit) {
  SpaceMesh mesh = cube(mesh::Shape::quadrilateral, 2);
  mesh.normals.resize(mesh.nodes.size());
  const std::int32_t node = mesh.cells[0].nodes[0];
  mesh.normals[node] = Vector3d::UnitX();
  const SurfaceTopology t = surface_topology(mesh, {});
  for (const DirectorNode& n : t.director_nodes) EXPECT_NEAR(n.director.cwiseAbs().maxCoeff(), 1, 1e-14);
}

TEST(Topology, does_not_depend_on_the_order_of_nodes_and_cells) {
  for (const mesh::Shape shape : shapes) {
    SpaceMesh mesh = star(shape, 4, 2, {0, 0.3, 0.95 * pi, 1.3 * pi});
    turn_some(mesh, 2);
    const SurfaceTopology t = surface_topology(mesh, {});
    const SurfaceSummary s = summary_of(t);
    for (unsigned seed = 1; seed < 6; ++seed) {
      const SurfaceTopology other = surface_topology(shuffled(mesh, seed), {});
      expect_manifold(other);
      const SurfaceSummary o = summary_of(other);
      EXPECT_EQ(other.sheet_count, t.sheet_count);
      EXPECT_EQ(other.director_nodes.size(), t.director_nodes.size());
      EXPECT_EQ(o.turned, s.turned);
      EXPECT_NEAR(other.largest_director_angle.angle, t.largest_director_angle.angle, 1e-12);
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(o.edges[k].number, s.edges[k].number);
        EXPECT_NEAR(o.edges[k].largest_angle, s.edges[k].largest_angle, 1e-9);
      }
    }
  }
}

TEST(DamagedMesh, is_refused_or_still_a_manifold) {
  std::mt19937 random(11);
  int accepted = 0, refused = 0;
  for (int i = 0; i < 1500; ++i) {
    const mesh::Shape shape = shapes[random() % 2];
    const int order = 1 + static_cast<int>(random() % 2);
    SpaceMesh mesh = random() % 2 == 0 ? star(shape, 2, order, {0, 1.5, 3, 4}) : tube(shape, {4, 2, order});
    for (auto n = 1 + random() % 4; n > 0; --n) damage(mesh, random);
    try {
      expect_manifold(surface_topology(mesh, {.smooth_angle = 0.5 + static_cast<double>(random() % 3)}));
      ++accepted;
    } catch (const mesh::DomainError&) {
      ++refused;
    }
  }
  EXPECT_GT(accepted, 200);
  EXPECT_GT(refused, 200);
}

TEST(Directors, turn_with_the_surface_and_do_not_depend_on_its_unit) {
  const SpaceMesh mesh = torus(mesh::Shape::quadrilateral, {12, 8, 2});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const SurfaceTopology t = surface_topology(mesh, {.smooth_angle = 1});
  for (const double scale : {1e-6, 1e6}) {
    SpaceMesh moved = mesh;
    for (Vector3d& x : moved.nodes) x = scale * (turn * x + Vector3d(10, -20, 5));
    const SurfaceTopology o = surface_topology(moved, {.smooth_angle = 1});
    for (std::size_t d = 0; d < t.director_nodes.size(); ++d)
      EXPECT_LT((o.director_nodes[d].director - turn * t.director_nodes[d].director).norm(), 1e-12);
  }
}

TEST(Merge, joins_nodes_along_borders_and_refuses_a_tolerance_above_the_size_of_a_cell) {
  SpaceMesh mesh{.nodes = {}, .cells = {}};
  add_grid({2, 2, 2}, plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
  add_grid({2, 2, 2}, plate({1 + 1e-4, 0, 0}, {1, 0, 0}, {0, 1, 0}), mesh);
  EXPECT_EQ(merge_nodes(mesh, 0.9e-4).merged, 0u);
  const MergedMesh merged = merge_nodes(mesh, 1.1e-4);
  EXPECT_EQ(merged.merged, 5u);
  EXPECT_EQ(merged.mesh.nodes.size(), 45u);
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t n = 0; n < 9; ++n)
      EXPECT_EQ(merged.mesh.cells[c].nodes[n], merged.new_number[mesh.cells[c].nodes[n]]);
  EXPECT_EQ(surface_topology(merged.mesh, {}).part_count, 1);
  EXPECT_THROW(merge_nodes(mesh, 0.3), mesh::DomainError);
}

}  // namespace
}  // namespace plastron::topology::space_meshes
