#include <plastron/zones/sub_cells.hpp>

namespace plastron::zones {

namespace {

std::vector<SubCell> sub_squares(int k) {
  const auto node = [k](int i, int j) { return j * (k + 1) + i; };
  std::vector<SubCell> all;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) all.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
  return all;
}

std::vector<SubCell> sub_triangles(int k) {
  const auto node = [k](int i, int j) { return j * (k + 1) - j * (j - 1) / 2 + i; };
  std::vector<SubCell> all;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i + j < k; ++i) {
      all.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      if (i + j + 2 <= k) all.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return all;
}

}  // namespace

std::vector<SubCell> sub_cells(fem::Shape shape, int degree) {
  return shape == fem::Shape::triangle ? sub_triangles(degree) : sub_squares(degree);
}

}  // namespace plastron::zones
