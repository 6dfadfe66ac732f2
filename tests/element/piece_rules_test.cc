// Rules between the borders of pieces: areas and moments that are known, on both shapes and on sides.
#include <plastron/element/piece_rules.hpp>
#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/pieces.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace plastron::element::piece_rules_test {
namespace {

using mesh::Shape;

/// The parameters are the reference coordinates.
std::vector<geometry::Place> unchanged(std::span<const Vector2d> xi) {
  std::vector<geometry::Place> places;
  for (const Vector2d& at : xi) places.push_back({.x = at[0], .y = at[1]});
  return places;
}

/// The integral of an expression of x = xi_1, y = xi_2 with a rule.
double integral(const PieceRule& rule, const std::string& text) {
  const geometry::Expression f(text, {});
  std::vector<double> value(rule.xi.size());
  f.evaluate(unchanged(rule.xi), value);
  return std::inner_product(value.begin(), value.end(), rule.weights.begin(), 0.0);
}

struct Known {
  std::string function;
  Shape shape;
  double integral;
};
void PrintTo(const Known& known, std::ostream* out) { *out << known.function; }

class PieceRules : public testing::TestWithParam<Known> {};
INSTANTIATE_TEST_SUITE_P(
    Known, PieceRules,
    testing::Values(Known{"x < 0.3", Shape::quadrilateral, 0.3},  // along xi_2
                    Known{"y > 0.7", Shape::quadrilateral, 0.3},  // along xi_1
                    Known{"x < 0.5", Shape::quadrilateral, 0.5},  // where the search divides the cell first
                    Known{"y > 0.25", Shape::quadrilateral, 0.75},
                    Known{"x < 0.5 && x + 2*y < 0.9", Shape::quadrilateral, 0.9 * 0.45 / 2 - 0.4 * 0.2 / 2},
                    Known{"x + 2*y < 0.9", Shape::quadrilateral, 0.9 * 0.45 / 2},  // a triangle
                    Known{"x > 0.2 && x < 0.2001", Shape::quadrilateral, 1e-4},    // a thin strip
                    Known{"(x-0.4)^2 + (y-0.5)^2 < 0.09", Shape::quadrilateral, std::numbers::pi * 0.09},  // a disc
                    Known{"x^2 + y^2 < 0.64", Shape::quadrilateral, std::numbers::pi * 0.16},  // a quarter of one
                    Known{"((x-0.5)/0.4)^2 + ((y-0.5)/0.01)^2 < 1", Shape::quadrilateral, std::numbers::pi * 0.004},
                    Known{"abs(x - y)", Shape::quadrilateral, 1.0 / 3},                 // a kink
                    Known{"max(x - 0.5, 0)*y", Shape::quadrilateral, 1.0 / 16},         //
                    Known{"x < 0.3", Shape::triangle, 0.5 - 0.7 * 0.7 / 2},             //
                    Known{"x + y < 0.6", Shape::triangle, 0.18},                        // along a side
                    Known{"x^2 + y^2 < 0.25", Shape::triangle, std::numbers::pi / 16},  //
                    Known{"abs(x - y)", Shape::triangle, 1.0 / 6}),                     //
    [](const auto& test) { return "Function" + std::to_string(test.index); });

TEST_P(PieceRules, HaveTheIntegralOfTheirFunctionAndOfTheWholeCell) {
  const auto& [function, shape, known] = GetParam();
  const geometry::Pieces pieces(geometry::Expression(function, {}));
  ASSERT_FALSE(are_one_piece({&pieces}, shape, unchanged));
  const auto rule = rule_between_borders({&pieces}, shape, 2, unchanged);
  ASSERT_TRUE(rule);
  const bool is_triangle = shape == Shape::triangle;
  EXPECT_NEAR(integral(*rule, function), known, 1e-7 * known);
  EXPECT_NEAR(integral(*rule, "1 + 0*x"), is_triangle ? 0.5 : 1, 1e-10);
  EXPECT_NEAR(integral(*rule, "x^2*y"), is_triangle ? 1.0 / 60 : 1.0 / 6, 1e-10);
  for (std::size_t i = 0; i < rule->xi.size(); ++i) {
    EXPECT_TRUE(mesh::holds(shape, rule->xi[i], 1e-12));
    EXPECT_GE(rule->weights[i], 0);
  }
}

TEST(PieceRules, FollowSeveralFunctionsTogether) {
  const geometry::Pieces disc(geometry::Expression("(x-0.4)^2 + (y-0.5)^2 < 0.09", {})),
      half(geometry::Expression("y < 0.5", {}));
  const auto rule = rule_between_borders({&disc, &half}, Shape::quadrilateral, 3, unchanged);
  ASSERT_TRUE(rule);
  EXPECT_NEAR(integral(*rule, "(y < 0.5)*((x-0.4)^2 + (y-0.5)^2 < 0.09)"), std::numbers::pi * 0.045, 1e-8);
  EXPECT_NEAR(integral(*rule, "y < 0.5"), 0.5, 1e-10);
}

// x = 2 xi_1 + xi_1 xi_2, so that the border x = 1 is curved in the cell: xi_1 = 1 / (2 + xi_2).
TEST(PieceRules, FollowBordersInACurvedCell) {
  const Places curved = [](std::span<const Vector2d> xi) {
    std::vector<geometry::Place> places;
    for (const Vector2d& at : xi) places.push_back({.x = at[0] * (2 + at[1]), .y = at[1]});
    return places;
  };
  const geometry::Pieces pieces(geometry::Expression("x < 1", {}));
  const auto rule = rule_between_borders({&pieces}, Shape::quadrilateral, 4, curved);
  ASSERT_TRUE(rule);
  double below = 0;
  for (std::size_t i = 0; i < rule->xi.size(); ++i)
    below += rule->xi[i][0] * (2 + rule->xi[i][1]) < 1 ? rule->weights[i] : 0;
  EXPECT_NEAR(below, std::log(1.5), 1e-8);
}

/// In a small cell far from zero, arithmetic cannot tell a line beside a border along it from the border.
TEST(PieceRules, FollowBordersAlongLinesOfSmallCells) {
  for (const char* function : {"x < 0.36", "y > 0.36", "abs(x - 0.31) < 0.05 && abs(y - 0.35) < 0.01"}) {
    const geometry::Pieces pieces(geometry::Expression(function, {}));
    for (int cells = 50; cells < 4000; cells += 137) {
      const double size = 1.0 / cells, low = std::floor(0.36 * cells) * size;
      std::size_t looks = 0;
      const Places places = [&](std::span<const Vector2d> xi) {
        ++looks;
        std::vector<geometry::Place> in_cell;
        for (const Vector2d& at : xi) in_cell.push_back({.x = low + size * at[0], .y = low + size * at[1]});
        return in_cell;
      };
      if (are_one_piece({&pieces}, Shape::quadrilateral, places)) continue;
      EXPECT_TRUE(rule_between_borders({&pieces}, Shape::quadrilateral, 2, places)) << function << cells;
      EXPECT_LT(looks, 100'000) << function << cells;
    }
  }
}

TEST(PieceRules, FindNoBorderWhereAFunctionIsSmooth) {
  const geometry::Pieces smooth(geometry::Expression("sin(x)*y", {})), elsewhere(geometry::Expression("x < 1.5", {})),
      here(geometry::Expression("x < 0.999", {}));
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle}) {
    EXPECT_TRUE(are_one_piece({&smooth, &elsewhere}, shape, unchanged));
    EXPECT_FALSE(are_one_piece({&smooth, &here}, shape, unchanged));
  }
}

TEST(PieceRules, OfSidesHaveTheLengthsOfTheirPieces) {
  const geometry::Pieces pieces(geometry::Expression("x + 2*y < 0.9", {}));
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle})
    for (int side = 0; side < mesh::corner_count(shape); ++side) {
      const auto rule = rule_between_borders({&pieces}, shape, side, 2, unchanged);
      ASSERT_TRUE(rule);
      const auto ends = mesh::side_corners(shape, side);
      const auto level = [&](int end) {
        const Vector2d xi = mesh::corner(shape, ends[static_cast<std::size_t>(end)]);
        return xi[0] + 2 * xi[1] - 0.9;
      };
      const double a = level(0), b = level(1);
      const double part = a * b < 0 ? std::abs(std::min(a, b)) / std::abs(b - a) : (a < 0 ? 1 : 0);
      EXPECT_NEAR(integral(*rule, "x + 2*y < 0.9"), part, 1e-10) << mesh::corner_count(shape) << ' ' << side;
      EXPECT_NEAR(std::accumulate(rule->weights.begin(), rule->weights.end(), 0.0), 1, 1e-12);
      const Vector2d from = mesh::corner(shape, ends[0]), along = mesh::corner(shape, ends[1]) - from;
      for (const Vector2d& xi : rule->xi)
        EXPECT_NEAR(along[0] * (xi - from)[1] - along[1] * (xi - from)[0], 0, 1e-12);  // on the side
    }
}

// A chessboard of 300 x 300 fields has too many borders to follow one by one.
TEST(PieceRules, GiveUpWhereBordersAreTooManyAndPartsDivideTheCellThen) {
  const geometry::Pieces many(geometry::Expression("sin(1000*x)*sin(1000*y) < 0", {}));
  EXPECT_FALSE(rule_between_borders({&many}, Shape::quadrilateral, 2, unchanged));
  const geometry::Pieces few(geometry::Expression("x + 2*y < 0.9", {}));
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle}) {
    PieceRule of_cell;
    const mesh::TriangleRule triangle = mesh::triangle_rule(4);
    if (shape == Shape::triangle) of_cell = {triangle.points, triangle.weights};
    const mesh::Rule line = mesh::gauss(3);
    for (std::size_t j = 0; j < 3 && shape == Shape::quadrilateral; ++j)
      for (std::size_t i = 0; i < 3; ++i) {
        of_cell.xi.emplace_back(line.points[i], line.points[j]);
        of_cell.weights.push_back(line.weights[i] * line.weights[j]);
      }
    const PieceRule parts = rule_of_parts({&few}, shape, of_cell, unchanged, 30'000);
    const bool is_triangle = shape == Shape::triangle;
    EXPECT_GT(parts.xi.size(), 10 * of_cell.xi.size());
    EXPECT_NEAR(integral(parts, "x + 2*y < 0.9"), 0.9 * 0.45 / 2, 1e-5);
    EXPECT_NEAR(integral(parts, "x^2*y"), is_triangle ? 1.0 / 60 : 1.0 / 6, 1e-7);  // one point in each small part
  }
}

}  // namespace
}  // namespace plastron::element::piece_rules_test
