// Labels of zones against a flood fill by places: random marks, both shapes, hanging nodes and joined edges.
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/zones/sub_cells.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "assembly/sample_shells.hpp"

namespace plastron::zones::zone_labels_test {
namespace {

using mesh::Shape;
using test::MeshedSurface;
using Place = std::array<std::int64_t, 3>;  ///< a point of the mid-surface in units of 1e-7

/// The places of the local nodes. Nodes identified across joined edges have one place.
std::vector<Place> places_of(const MeshedSurface& mesh) {
  const fem::Space& space = *mesh.space;
  const auto xi = element::element_tables(space.shape(), space.degree, false).nodes;
  std::vector<Place> places(static_cast<std::size_t>(space.layout->local_size()));
  std::vector<geometry::Frame> frames(xi.size());
  for (std::size_t c = 0; c < space.cells.size(); ++c) {
    mesh.surface->frames(space.cells[c], xi, frames, false);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      Place& place = places[static_cast<std::size_t>(space.nodes(c)[i])];
      for (int k = 0; k < 3; ++k) place[static_cast<std::size_t>(k)] = std::llround(1e7 * frames[i].phi[k]);
    }
  }
  return places;
}

/// Whether two nodes of a cell are corners of one sub-cell, from their steps along the lattice.
bool are_beside(const fem::Space& space, int a, int b) {
  const auto lattice = mesh::lattice(space.shape(), space.degree);
  const Eigen::Vector2d way =
      space.degree * (lattice[static_cast<std::size_t>(b)] - lattice[static_cast<std::size_t>(a)]);
  const auto i = std::lround(way[0]), j = std::lround(way[1]);
  if (std::abs(i) > 1 || std::abs(j) > 1) return false;
  return space.shape() == Shape::quadrilateral || i * j <= 0;  // triangles have the diagonal (1, -1) alone
}

using Neighbours = std::map<Place, std::set<Place>>;

Neighbours neighbours_of(const fem::Space& space, const std::vector<Place>& places) {
  Neighbours all;
  const auto join = [&](algebra::LocalIndex a, algebra::LocalIndex b) {
    const Place &p = places[static_cast<std::size_t>(a)], &q = places[static_cast<std::size_t>(b)];
    all[p].insert(q);
    all[q].insert(p);
  };
  for (std::size_t c = 0; c < space.cells.size(); ++c)
    for (int a = 0; a < space.nodes_per_cell(); ++a)
      for (int b = 0; b < space.nodes_per_cell(); ++b)
        if (are_beside(space, a, b))
          join(space.nodes(c)[static_cast<std::size_t>(a)], space.nodes(c)[static_cast<std::size_t>(b)]);
  for (const constraints::Row& row : space.continuity.rows())
    for (const constraints::Term& term : row.terms) join(row.node, term.node);
  return all;
}

/// Zones by place: a number for each place inside.
std::map<Place, int> flood_fill(const Neighbours& neighbours, const std::set<Place>& inside) {
  std::map<Place, int> zones;
  int count = 0;
  for (const Place& start : inside) {
    if (zones.contains(start)) continue;
    std::vector<Place> open{start};
    zones[start] = count;
    while (!open.empty()) {
      const Place at = open.back();
      open.pop_back();
      for (const Place& next : neighbours.at(at))
        if (inside.contains(next) && zones.emplace(next, count).second) open.push_back(next);
    }
    ++count;
  }
  return zones;
}

struct Found {
  int most = 0;  ///< largest number of zones
};

/// Compares labels with the flood fill for several random patterns.
Found expect_labels_of_flood_fill(const MeshedSurface& mesh) {
  const fem::Space& space = *mesh.space;
  const std::vector<Place> places = places_of(mesh);
  const Neighbours neighbours = neighbours_of(space, places);
  Found found;
  std::mt19937 random(5);
  for (const double part : {0.0, 0.1, 0.25, 0.4, 0.7, 1.0}) {
    std::bernoulli_distribution is_marked(part);
    std::set<Place> inside;
    for (const auto& [place, beside] : neighbours)
      if (is_marked(random)) inside.insert(place);
    std::vector<char> marks;
    for (const Place& place : places) marks.push_back(inside.contains(place) ? 1 : 0);
    const ZoneLabels labels = zone_labels(space, marks);
    const std::map<Place, int> expected = flood_fill(neighbours, inside);
    std::set<std::pair<int, int>> pairs;
    std::set<int> numbers, zones;
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(labels.of_node[i] >= 0, marks[i] != 0);
      if (marks[i] == 0) continue;
      pairs.emplace(labels.of_node[i], expected.at(places[i]));
      numbers.insert(labels.of_node[i]);
      zones.insert(expected.at(places[i]));
    }
    EXPECT_EQ(pairs.size(), zones.size()) << part;  // one label for each zone, and the reverse
    EXPECT_EQ(numbers.size(), zones.size()) << part;
    EXPECT_EQ(labels.count, static_cast<int>(zones.size())) << part;
    if (!numbers.empty()) {
      EXPECT_EQ(*numbers.begin(), 0);
      EXPECT_EQ(*numbers.rbegin(), labels.count - 1);
    }
    found.most = std::max(found.most, labels.count);
  }
  return found;
}

TEST(ZoneLabels, AreThoseOfAFloodFill) {
  for (const auto& [shape, degree] :
       {std::pair{Shape::quadrilateral, 1}, std::pair{Shape::quadrilateral, 2}, std::pair{Shape::quadrilateral, 3},
        std::pair{Shape::quadrilateral, 5}, std::pair{Shape::triangle, 1}, std::pair{Shape::triangle, 2}}) {
    SCOPED_TRACE(degree);
    const Found found = expect_labels_of_flood_fill(test::meshed(test::skew(), test::saddle, degree, 3, shape));
    EXPECT_GT(found.most, 2);
  }
}

TEST(ZoneLabels, GoOnAcrossHangingNodes) {
  for (const int degree : {1, 2, 4}) {
    SCOPED_TRACE(degree);
    fem::MeshSequence meshes(domain::coarse_mesh(domain::Rectangle{.cells = {4, 4}}, Shape::quadrilateral), degree,
                             MPI_COMM_WORLD);
    for (int pass = 0; pass < 2; ++pass) {
      std::vector<signed char> marks(meshes.space()->owned_cells, 0);
      for (std::size_t c = 0; c < marks.size(); c += 5) marks[c] = 1;
      meshes.refine({}, marks);
    }
    ASSERT_FALSE(meshes.space()->continuity.is_identity());
    std::map<std::string, geometry::Chart> charts;
    charts.emplace("", geometry::Chart(test::flat, {}));
    expect_labels_of_flood_fill({meshes.space(), std::make_shared<const fem::Surface>(meshes.space()->coarse, charts)});
  }
}

/// A tube whose seam joins the edges left and right: places there are the same, and nodes are not.
TEST(ZoneLabels, GoOnAcrossJoinedEdges) {
  for (const auto& [shape, degree] : {std::pair{Shape::quadrilateral, 2}, std::pair{Shape::triangle, 2}}) {
    const auto coarse = domain::coarse_mesh(domain::Rectangle{.to = {2 * std::numbers::pi, 2}, .cells = {8, 4}}, shape);
    std::map<std::string, geometry::Chart> charts;
    charts.emplace("", geometry::Chart({"sin(x)", "y", "cos(x)"}, {}));
    std::shared_ptr<const fem::Surface> surface;
    const fem::MeshSequence meshes(coarse, degree, MPI_COMM_WORLD, [&](std::shared_ptr<const fem::Space> space) {
      surface = std::make_shared<const fem::Surface>(space->coarse, charts);
      return fem::joined(std::move(space), *surface, {{{"left", "right"}}});
    });
    const MeshedSurface tube{meshes.space(), surface};
    const std::vector<Place> places = places_of(tube);
    ASSERT_LT(std::set<Place>(places.begin(), places.end()).size(), places.size());
    expect_labels_of_flood_fill(tube);
  }
}

}  // namespace
}  // namespace plastron::zones::zone_labels_test
