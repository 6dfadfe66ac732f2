// Contact that a test prescribes node by node: the edge's part of it, its width, its places, and their order.
#include <gtest/gtest.h>
#include <plastron/solution/contact_faces.hpp>
#include <plastron/solution/contact_forces.hpp>
#include <plastron/solution/contact_width.hpp>
#include <plastron/solution/place_order.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "solution/scenes.hpp"

namespace plastron::solution::nodal_contact_test {
namespace {

using namespace plastron::test;

constexpr double width = 1.2, height = 0.9;
const domain::Rectangle plate{.to = {width, height}, .cells = {3, 3}};

/// A flat plate that touches a table where a function of the node says so, with a pressure of the node.
struct Touched {
  using Mark = std::function<bool(const assembly::NodalPoint&)>;
  using Pressure = std::function<double(std::size_t node)>;

  Touched(int degree, const Mark& is_touching, mesh::Shape shape = quadrilateral, double thickness = 0.1,
          std::vector<assembly::Support> supports = {}) {
    const MeshedSurface m = meshed(plate, flat, degree, 0, shape);
    discrete = assembly::discretise(m.space, m.surface,
                                    {.sections = steel_of(geometry::Expression(thickness)),
                                     .supports = std::move(supports),
                                     .obstacles = {.all = {{.name = "table", .face = obstacle::Face::lower}}}});
    nodal = {.y = algebra::Vector(m.space->layout, 6),
             .pressure = algebra::Vector(m.space->layout, 1),
             .touching = algebra::Vector(m.space->layout, 1)};
    for (std::size_t i = 0; i < discrete->points.size(); ++i)
      nodal.touching.local()[i] = is_touching(discrete->points[i]) ? 1 : 0;
  }
  void set_pressure(const Pressure& pressure) {
    for (std::size_t i = 0; i < discrete->points.size(); ++i)
      if (nodal.touching.local()[i] > 0) nodal.pressure.local()[i] = pressure(i);
  }
  /// Whether marks are positive, by node.
  std::vector<bool> positive(const algebra::Vector& marks) const {
    std::vector<bool> result;
    for (const double mark : marks.local()) result.push_back(mark > 0);
    return result;
  }
  ContactWidth width() const { return {*discrete, contact_faces(*discrete, nodal).touching}; }

  std::unique_ptr<assembly::DiscreteShell> discrete;
  NodalSolution nodal;
};

bool everywhere(const assembly::NodalPoint& /*point*/) { return true; }
bool on_rim(const assembly::NodalPoint& p) {
  return std::min({p.x[0], p.x[1], width - p.x[0], height - p.x[1]}) < 1e-9;
}

struct Element {
  mesh::Shape shape;
  int degree;
};
const std::vector<Element> elements{{quadrilateral, 1}, {quadrilateral, 2}, {quadrilateral, 5}, {triangle, 1}};

// A line reaction q on the rim: each node carries q times its length of edge, however small its area is.
TEST(EdgeContact, FindsALineReactionThatDoesNotDependOnTheMesh) {
  constexpr double q = 0.7;
  for (const Element& element : elements) {
    Touched scene(element.degree, on_rim, element.shape);
    std::map<std::size_t, double> lengths;
    for (const std::string& side : sides_of_rectangle)
      for (const auto& [node, length] : edge_lengths(*scene.discrete, side)) lengths[node] += length;
    scene.set_pressure([&](std::size_t i) { return q * lengths.at(i) / scene.discrete->points[i].weight; });
    const EdgeContact edge = edge_contact(*scene.discrete, scene.nodal);
    EXPECT_EQ(edge.nodes, static_cast<std::int64_t>(lengths.size()));
    EXPECT_NEAR(edge.force, q * 2 * (width + height), 1e-12);
    EXPECT_NEAR(edge.max_per_length, q, 1e-12);
    EXPECT_EQ(edge.pressure_inside, 0);
    EXPECT_TRUE(edge.is_line());
  }
}

TEST(EdgeContact, OfAUniformPressureIsItsPartOfTheAreaAndNoLine) {
  constexpr double p = 0.3;
  for (const Element& element : elements) {
    Touched scene(element.degree, everywhere, element.shape);
    scene.set_pressure([](std::size_t) { return p; });
    const EdgeContact edge = edge_contact(*scene.discrete, scene.nodal);
    EXPECT_NEAR(edge.force, p * edge.area, 1e-12);
    EXPECT_EQ(edge.pressure_inside, p);
    EXPECT_FALSE(edge.is_line());
    double area = 0, force = 0;
    for (const ContactForce& each : contact_forces(*scene.discrete, scene.nodal)) {
      area += each.area;
      force += each.force[2];
      EXPECT_NEAR(each.place[2], 0.3 - 0.05, 1e-15);
    }
    EXPECT_NEAR(area, width * height, 1e-12);
    EXPECT_NEAR(force, p * width * height, 1e-12);
    EXPECT_LT(edge.area, area);
  }
}

TEST(Edges, AreAllSidesOfTheRimButThoseInPlanesOfSymmetry) {
  for (unsigned mirrored = 0; mirrored < 16; ++mirrored) {
    std::vector<assembly::Support> supports;
    for (unsigned k = 0; k < 4; ++k) {
      supports.push_back(held(sides_of_rectangle[k], 4));
      if (((mirrored >> k) & 1U) == 0) continue;
      supports.push_back(held(sides_of_rectangle[k], 9, {Direction::conormal, Direction::conormal, Direction::z}));
      supports.back().symmetry = true;
    }
    const Touched scene(2, everywhere, quadrilateral, 0.1, supports);
    const auto open = static_cast<std::size_t>(4 - std::popcount(mirrored));
    EXPECT_EQ(edge_sides(*scene.discrete).size(), 3 * open);
    std::set<std::size_t> expected;
    for (unsigned k = 0; k < 4; ++k)
      if (((mirrored >> k) & 1U) == 0)
        for (const auto& [node, length] : edge_lengths(*scene.discrete, sides_of_rectangle[k])) expected.insert(node);
    const std::vector<char> marks = nodes_on_edges(*scene.discrete);
    for (std::size_t i = 0; i < marks.size(); ++i) EXPECT_EQ(marks[i] != 0, expected.contains(i));
  }
}

// Drawn pressures: the list of forces has an order and a sum.
TEST(ContactForces, AreOrderedByPlaceAndHaveTheSumOfPressureTimesArea) {
  Random random(1);
  for (const Element& element : elements) {
    Touched scene(
        element.degree, [&](const auto&) { return drawn(random) > 0; }, element.shape);
    scene.set_pressure([&](std::size_t) { return drawn(random, 0, 1); });
    const std::vector<ContactForce> forces = contact_forces(*scene.discrete, scene.nodal);
    double expected = 0, sum = 0;
    for (std::size_t i = 0; i < scene.discrete->points.size(); ++i)
      expected += scene.nodal.pressure.local()[i] * scene.discrete->points[i].weight;
    for (const ContactForce& force : forces) sum += force.force[2];
    EXPECT_NEAR(sum, expected, 1e-14);
    EXPECT_TRUE(std::ranges::is_sorted(forces, {},
                                       [](const ContactForce& force) { return std::pair(force.x[0], force.x[1]); }));
    EXPECT_EQ(static_cast<double>(forces.size()),
              std::accumulate(scene.nodal.touching.local().begin(), scene.nodal.touching.local().end(), 0.0));
  }
}

/// Whether an owned cell belongs, for each of the 3 x 3 cells in rows from the lower left one.
using Cells = std::array<std::array<bool, 3>, 3>;

/// The nodes of these cells.
std::vector<bool> nodes_of(const assembly::DiscreteShell& discrete, const Cells& cells) {
  std::vector<bool> marks(discrete.points.size(), false);
  for (std::size_t i = 0; i < marks.size(); ++i)
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column) {
        const double x = 3 * discrete.points[i].x[0] / width - static_cast<double>(column),
                     y = 3 * discrete.points[i].x[1] / height - static_cast<double>(row);
        if (cells[row][column] && x > -1e-9 && x < 1 + 1e-9 && y > -1e-9 && y < 1 + 1e-9) marks[i] = true;
      }
  return marks;
}
bool touches(const Cells& cells, std::size_t row, std::size_t column) {
  for (std::size_t i = row > 0 ? row - 1 : 0; i < std::min<std::size_t>(row + 2, 3); ++i)
    for (std::size_t j = column > 0 ? column - 1 : 0; j < std::min<std::size_t>(column + 2, 3); ++j)
      if (cells[i][j]) return true;
  return false;
}

// All 512 sets of full cells. A thick plate: no row of nodes that is narrower than a cell is wide.
TEST(ContactWidth, HasAreaInAndBesideFullCellsAndAnInsideInAndBesideCellsAmongFullOnes) {
  for (const int degree : {1, 2}) {
    Touched scene(degree, everywhere, quadrilateral, 2);
    for (unsigned set = 0; set < 512; ++set) {
      Cells given{}, full{}, inside{}, with_area{}, with_inside{};
      const auto for_cells = [](const auto& visit) {
        for (std::size_t row = 0; row < 3; ++row)
          for (std::size_t column = 0; column < 3; ++column) visit(row, column);
      };
      for_cells([&](std::size_t i, std::size_t j) { given[i][j] = ((set >> (3 * i + j)) & 1U) != 0; });
      const std::vector<bool> touching = nodes_of(*scene.discrete, given);
      for (std::size_t i = 0; i < touching.size(); ++i) scene.nodal.touching.local()[i] = touching[i] ? 1 : 0;
      // Cells among given ones may be full without being given.
      for_cells([&](std::size_t i, std::size_t j) {
        Cells one{};
        one[i][j] = true;
        const std::vector<bool> own = nodes_of(*scene.discrete, one);
        full[i][j] = true;
        for (std::size_t k = 0; k < own.size(); ++k)
          if (own[k] && !touching[k]) full[i][j] = false;
      });
      Cells open{};
      for_cells([&](std::size_t i, std::size_t j) { open[i][j] = !full[i][j]; });
      for_cells([&](std::size_t i, std::size_t j) { inside[i][j] = full[i][j] && !touches(open, i, j); });
      // Cells that touch beside a full one belong, and all cells beside a full one touch.
      for_cells([&](std::size_t i, std::size_t j) { with_area[i][j] = touches(full, i, j); });
      Cells beside_inside{};
      for_cells([&](std::size_t i, std::size_t j) { beside_inside[i][j] = full[i][j] && touches(inside, i, j); });
      for_cells([&](std::size_t i, std::size_t j) { with_inside[i][j] = touches(beside_inside, i, j); });
      const ContactWidth contact = scene.width();
      EXPECT_EQ(scene.positive(contact.with_area()), nodes_of(*scene.discrete, with_area)) << "set " << set;
      EXPECT_EQ(scene.positive(contact.with_inside()), nodes_of(*scene.discrete, with_inside)) << "set " << set;
    }
  }
}

// A strip across the plate through the middle of its cells, of nodes up to half its width away from x = 0.6.
TEST(ContactWidth, OfAStripIsWiderThanALineFromHalfTheThicknessOn) {
  constexpr int degree = 4;
  for (const double half : {0.01, 0.15}) {
    const auto strip = [half](const assembly::NodalPoint& p) { return std::abs(p.x[0] - width / 2) < half; };
    double across = 0;
    const Touched first(degree, strip);
    for (const assembly::NodalPoint& p : first.discrete->points)
      if (strip(p)) across = std::max(across, 2 * std::abs(p.x[0] - width / 2));
    EXPECT_EQ(across > 0, half > 0.1);
    for (const double part : {0.9, 1.1}) {
      const Touched scene(degree, strip, quadrilateral, part * 2 * std::max(across, 0.01));
      const ContactWidth contact = scene.width();
      const std::vector<bool> marks = scene.positive(contact.with_area());
      EXPECT_EQ(std::ranges::count(marks, true) > 0, across > 0 && part < 1) << half << ", " << part;
      for (std::size_t cell : {1U, 4U, 7U}) EXPECT_EQ(contact.direction_across(cell, 0), 0);
    }
  }
}

// Places are compared in units that rounding does not cross where they are even divisions of the whole.
TEST(PlaceOrder, IsThatOfDivisionsAndDoesNotFeelRounding) {
  Random random(2);
  for (int draw = 0; draw < 200; ++draw) {
    const double whole = std::exp(drawn(random, -9, 9));
    const auto n = static_cast<int>(drawn_number(random, 1023)) + 1;
    const double at = whole * n / 1024, noise = 1 + 4e-15 * drawn(random), next = whole * (n + 1) / 1024;
    EXPECT_EQ(in_units(at * noise, whole), in_units(at, whole));
    EXPECT_LT(in_units(at, whole), in_units(next, whole));
    EXPECT_EQ(in_units(-at, whole), -in_units(at, whole));
    EXPECT_EQ(in_units(Eigen::Vector3d(at, -at, 0), whole),
              (std::array<std::int64_t, 3>{in_units(at, whole), -in_units(at, whole), 0}));
  }
  EXPECT_EQ(in_units(1, 0), 0);
  EXPECT_EQ(in_units(std::numeric_limits<double>::quiet_NaN(), 1), 0);
  EXPECT_EQ(in_units(std::numeric_limits<double>::infinity(), 1), 0);
}

}  // namespace
}  // namespace plastron::solution::nodal_contact_test
