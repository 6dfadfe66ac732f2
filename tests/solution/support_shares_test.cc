// Shares of supports in the forces at nodes: they add up to the whole, each carrier has forces only where it holds the shell, and a
// corner has what the line densities of its edges leave.
#include <gtest/gtest.h>
#include <plastron/solution/support_shares.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "solution/scenes.hpp"

namespace plastron::solution::support_shares_test {
namespace {

using assembly::Vector6;
using namespace plastron::test;

const domain::Rectangle plate{.to = {1.2, 0.9}, .cells = {3, 3}};
const std::array<std::string, 3> bent{"x + 0.2*y", "y - 0.1*x", "0.3*x*y + 0.1*x^2"};

std::unique_ptr<assembly::DiscreteShell> shell_of(const domain::Domain& domain, const std::array<std::string, 3>& chart,
                                                  int degree, std::vector<assembly::Support> supports,
                                                  double thickness = 0.05, mesh::Shape shape = quadrilateral) {
  const MeshedSurface m = meshed(domain, chart, degree, 0, shape);
  return assembly::discretise(m.space, m.surface,
                              {.sections = steel_of(geometry::Expression(thickness)), .supports = std::move(supports)});
}

/// The sum over nodes of a carrier's shares in the forces.
Vector6 total(const SupportShares& shares, std::size_t carrier, const std::vector<Vector6>& forces) {
  Vector6 sum = Vector6::Zero();
  for (std::size_t node = 0; node < forces.size(); ++node)
    for (const SupportShares::Share& share : shares.at(node))
      if (share.carrier == carrier) sum += share.part * forces[node];
  return sum;
}

Matrix6 part_of(const SupportShares& shares, std::size_t node, std::size_t carrier) {
  for (const SupportShares::Share& share : shares.at(node))
    if (share.carrier == carrier) return share.part;
  return Matrix6::Zero();
}

/// Components along the shell's own and along Cartesian directions, on a drawn part of the edges and at some points.
std::vector<assembly::Support> drawn_supports(Random& random) {
  std::vector<assembly::Support> supports;
  for (const std::string& side : sides_of_rectangle) {
    if (drawn_number(random, 3) == 0) continue;
    supports.push_back(held(side, drawn_number(random, 62) + 1));
    if (drawn_number(random, 1) == 0)
      supports.push_back(
          held(side, drawn_number(random, 62) + 1, {Direction::conormal, Direction::tangent, Direction::normal}));
  }
  for (const Eigen::Vector2d& point : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.4, 0.3), Eigen::Vector2d(1.2, 0.6)})
    if (drawn_number(random, 1) == 0) supports.push_back(held_at(point, drawn_number(random, 6) + 1));
  return supports;
}

struct Element {
  mesh::Shape shape;
  int degree;
};
constexpr std::array elements{Element{quadrilateral, 1}, Element{quadrilateral, 2}, Element{quadrilateral, 5},
                              Element{triangle, 1}, Element{triangle, 2}};

TEST(SupportShares, AddUpToTheWholeAtEveryNode) {
  Random random(1);
  for (const Element& element : elements)
    for (int draw = 0; draw < 6; ++draw) {
      const auto supports = drawn_supports(random);
      const double thickness = draw % 2 == 0 ? 0.01 : 0.2;
      const auto discrete = shell_of(plate, bent, element.degree, supports, thickness, element.shape);
      const SupportShares shares(*discrete);
      std::size_t supported = 0;
      for (std::size_t node = 0; node < discrete->points.size(); ++node) {
        if (shares.at(node).empty()) continue;
        ++supported;
        Matrix6 sum = Matrix6::Zero();
        std::set<std::size_t> carriers;
        for (const SupportShares::Share& share : shares.at(node)) {
          sum += share.part;
          EXPECT_LT(share.carrier, shares.carriers());
          EXPECT_TRUE(carriers.insert(share.carrier).second);  // one share for each carrier
        }
        EXPECT_LT((sum - Matrix6::Identity()).norm(), 1e-10) << "degree " << element.degree << ", draw " << draw;
      }
      EXPECT_EQ(supported > 0, !supports.empty());
    }
}

TEST(SupportShares, OfOneEdgeAreItsOwnNodesAlone) {
  for (const int degree : {1, 2, 4})
    for (const std::string& side : sides_of_rectangle) {
      const auto discrete = shell_of(plate, bent, degree, {held(side, 4)});
      const SupportShares shares(*discrete);
      EXPECT_EQ(shares.boundaries(), std::vector<std::string>{side});
      EXPECT_TRUE(shares.corners().empty());
      const auto on_edge = edge_lengths(*discrete, side);
      EXPECT_EQ(on_edge.size(), static_cast<std::size_t>(3 * degree + 1));
      for (std::size_t node = 0; node < discrete->points.size(); ++node)
        EXPECT_EQ(part_of(shares, node, 0), (on_edge.contains(node) ? 1 : 0) * Matrix6::Identity());
    }
}

/// The directions that components fix on a flat plate: with a rotation r . a_3, too.
unsigned fixed(unsigned bits) { return (bits & 24U) != 0 ? bits | 32U : bits; }

// All 31 x 31 pairs would be the same test: it draws from them. Drilling rotations (32) come with others alone.
TEST(SupportShares, BelongToTheOneEdgeThatFixesADirectionAndToTheCornerIfBothDo) {
  Random random(2);
  for (int draw = 0; draw < 60; ++draw) {
    const unsigned left = drawn_number(random, 30) + 1, bottom = drawn_number(random, 30) + 1,
                   point = drawn_number(random, 7), shared = fixed(left) & fixed(bottom);
    std::vector<assembly::Support> supports{held("left", left), held("bottom", bottom)};
    if (point != 0) supports.push_back(held_at({0, 0}, point));
    const auto discrete = shell_of(plate, flat, 2, supports);
    const SupportShares shares(*discrete);
    SCOPED_TRACE(testing::Message() << "left " << left << ", bottom " << bottom << ", point " << point);
    ASSERT_EQ(shares.corners().size(), shared != 0 ? 1U : 0U);
    const std::size_t corners = shares.corners().size();
    ASSERT_EQ(shares.carriers(), 2 + corners + (point != 0 ? 1 : 0));
    if (corners == 1) {
      EXPECT_LT(shares.corners()[0].at.norm(), 1e-14);
      EXPECT_EQ(shares.corners()[0].boundaries, (std::vector<std::size_t>{0, 1}));
      EXPECT_NEAR(shares.corners()[0].reach, 0.09, 1e-12);  // a tenth of the shorter edge, below two thicknesses
    }
    for (std::size_t node = 0; node < discrete->points.size(); ++node) {
      const Eigen::Vector2d& x = discrete->points[node].x;
      const bool on_left = x[0] < 1e-12, on_bottom = x[1] < 1e-12, in_corner = on_left && on_bottom;
      EXPECT_EQ(shares.at(node).empty(), !on_left && !on_bottom);
      for (unsigned k = 0; k < 6; ++k) {
        const unsigned bit = 1U << k;
        const bool by_left = on_left && (fixed(left) & bit) != 0, by_bottom = on_bottom && (fixed(bottom) & bit) != 0,
                   by_point = in_corner && (point & bit) != 0;
        std::size_t carrier = 0;
        if (in_corner && by_left && by_bottom)
          carrier = 2;
        else if ((shared & bit) != 0)
          continue;  // beside the corner its edges give up a part
        else if (by_left)
          carrier = 0;
        else if (by_bottom)
          carrier = 1;
        else if (by_point)
          carrier = 2 + corners;
        else
          continue;
        for (std::size_t each = 0; each < shares.carriers(); ++each) {
          const Vector6 force = part_of(shares, node, each).col(static_cast<Eigen::Index>(k));
          const Vector6 expected = each == carrier ? Vector6(Vector6::Unit(k)) : Vector6(Vector6::Zero());
          EXPECT_LT((force - expected).norm(), 1e-12) << "node at " << x.transpose() << ", direction " << k;
        }
      }
    }
  }
}

// The forces of line densities q that are constant along each edge, and forces P at the corners. The reach of a corner has one
// node at low degrees and three at high ones.
TEST(SupportShares, OfConstantLineDensitiesLeaveToTheCornersTheirPointForces) {
  Random random(3);
  for (const int degree : {1, 2, 3, 4, 6})
    for (const double thickness : {0.001, 0.03, 0.3}) {
      std::vector<assembly::Support> supports;
      for (const std::string& side : sides_of_rectangle) supports.push_back(held(side, 63));
      const auto discrete = shell_of(plate, flat, degree, supports, thickness);
      const SupportShares shares(*discrete);
      ASSERT_EQ(shares.boundaries(), std::vector<std::string>(sides_of_rectangle.begin(), sides_of_rectangle.end()));
      ASSERT_EQ(shares.corners().size(), 4U);
      std::vector<Vector6> forces(discrete->points.size(), Vector6::Zero());
      std::vector<Vector6> whole;
      for (const std::string& side : sides_of_rectangle) {
        const Vector6 density = Vector6::NullaryExpr([&] { return drawn(random); });
        whole.emplace_back(Vector6::Zero());
        for (const auto& [node, length] : edge_lengths(*discrete, side)) {
          forces[node] += length * density;
          whole.back() += length * density;
        }
      }
      std::vector<Vector6> at_corners;
      for (const SupportCorner& corner : shares.corners())
        for (std::size_t node = 0; node < forces.size(); ++node)
          if ((discrete->points[node].phi - corner.place).norm() < 1e-12) {
            at_corners.emplace_back(Vector6::NullaryExpr([&] { return drawn(random); }));
            forces[node] += at_corners.back();
          }
      ASSERT_EQ(at_corners.size(), 4U);
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_LT((shares.corners()[c].shared - Matrix6::Identity()).norm(), 1e-12);
        EXPECT_LT((total(shares, 4 + c, forces) - at_corners[c]).norm(), 1e-12) << degree << ", e = " << thickness;
      }
      for (std::size_t b = 0; b < 4; ++b)
        EXPECT_LT((total(shares, b, forces) - whole[b]).norm(), 1e-12) << degree << ", e = " << thickness;
    }
}

// Both edges of a polygon between them bend by this angle.
TEST(SupportShares, OfEdgesThatContinueEachOtherAreAsTheirLengths) {
  for (const double degrees : {0.0, 0.5, 2.0, 30.0}) {
    const double bend = degrees * std::numbers::pi / 180;
    const domain::Polygon polygon{{{0, 0}, {1, 0}, {1 + 1.5 * std::cos(bend), 1.5 * std::sin(bend)}, {2, 2}, {0, 1}}};
    const auto discrete = shell_of(polygon, flat, 2, {held("edge1", 7), held("edge2", 7)});
    const SupportShares shares(*discrete);
    SCOPED_TRACE(degrees);
    ASSERT_EQ(shares.corners().size(), degrees > 1 ? 1U : 0U);
    const auto first = edge_lengths(*discrete, "edge1"), second = edge_lengths(*discrete, "edge2");
    int joins = 0;
    for (const auto& [node, length] : first) {
      if (!second.contains(node)) continue;
      ++joins;
      const double part = length / (length + second.at(node));
      for (std::size_t carrier = 0; carrier < 2; ++carrier) {
        const Eigen::Matrix3d expected = (degrees > 1    ? 0
                                          : carrier == 0 ? part
                                                         : 1 - part) *
                                         Eigen::Matrix3d::Identity();
        EXPECT_LT((part_of(shares, node, carrier).topLeftCorner<3, 3>() - expected).norm(), 1e-12);
      }
    }
    EXPECT_EQ(joins, 1);
  }
}

TEST(SupportShares, TurnWithTheScene) {
  Random random(4);
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = quarter();
  int compared = 0;
  for (int draw = 0; draw < 12; ++draw) {
    const auto supports = drawn_supports(random);
    std::vector<assembly::Support> turned_supports;
    for (const assembly::Support& support : supports) turned_supports.push_back(turned(support));
    const auto given = shell_of(plate, bent, 2, supports), moved = shell_of(plate, turned(bent), 2, turned_supports);
    const SupportShares before(*given), after(*moved);
    ASSERT_EQ(after.carriers(), before.carriers());
    ASSERT_EQ(after.corners().size(), before.corners().size());
    const std::size_t edges = before.boundaries().size(), corners = before.corners().size();
    // Corners are in the order of their places, which turn.
    const auto moved_carrier = [&](std::size_t carrier) {
      if (carrier < edges || carrier >= edges + corners) return carrier;
      const auto found = std::ranges::find_if(after.corners(), [&](const SupportCorner& corner) {
        return (corner.at - before.corners()[carrier - edges].at).norm() < 1e-12;
      });
      EXPECT_NE(found, after.corners().end());
      return edges + static_cast<std::size_t>(found - after.corners().begin());
    };
    for (std::size_t node = 0; node < given->points.size(); ++node)
      for (const SupportShares::Share& share : before.at(node)) {
        const Matrix6 expected = turn * share.part * turn.transpose();
        EXPECT_LT((part_of(after, node, moved_carrier(share.carrier)) - expected).norm(), 1e-10) << "draw " << draw;
        ++compared;
      }
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace plastron::solution::support_shares_test
