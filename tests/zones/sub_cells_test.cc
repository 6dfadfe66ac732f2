// Sub-cells fill the cell, each once, and lie anticlockwise.
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/zones/sub_cells.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace plastron::zones {
namespace {

using mesh::Shape;

double area(const SubCell& sub, const std::vector<Eigen::Vector2d>& nodes) {
  double twice = 0;
  for (std::size_t i = 0; i < sub.size(); ++i) {
    const Eigen::Vector2d &a = nodes[static_cast<std::size_t>(sub[i])],
                          &b = nodes[static_cast<std::size_t>(sub[(i + 1) % sub.size()])];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

TEST(SubCells, HaveEqualPositiveAreasThatFillTheCell) {
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle})
    for (int k = 1; k <= (shape == Shape::triangle ? 4 : 8); ++k) {
      const auto subs = sub_cells(shape, k);
      ASSERT_EQ(subs.size(), static_cast<std::size_t>(k * k));
      const double whole = shape == Shape::triangle ? 0.5 : 1;
      for (const SubCell& sub : subs) EXPECT_NEAR(area(sub, mesh::lattice(shape, k)), whole / (k * k), 1e-14);
    }
}

TEST(SubCells, ShareEachSideInsideTheCellInOppositeSenses) {
  for (const Shape shape : {Shape::quadrilateral, Shape::triangle})
    for (int k = 1; k <= 4; ++k) {
      std::map<std::pair<int, int>, int> sides;
      for (const SubCell& sub : sub_cells(shape, k))
        for (std::size_t i = 0; i < sub.size(); ++i) ++sides[{sub[i], sub[(i + 1) % sub.size()]}];
      const auto alone = std::ranges::count_if(sides, [&](const auto& side) {
        return !sides.contains({side.first.second, side.first.first});
      });
      EXPECT_EQ(alone, mesh::corner_count(shape) * k);  // those on the cell's own sides
      for (const auto& [side, count] : sides) EXPECT_EQ(count, 1);
    }
}

}  // namespace
}  // namespace plastron::zones
