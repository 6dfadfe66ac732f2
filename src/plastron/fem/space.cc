#include <plastron/fem/space.hpp>

namespace plastron::fem {

std::vector<int> side_nodes(int degree, int side) {
  const int n = degree + 1;
  std::vector<int> nodes(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    nodes[static_cast<std::size_t>(i)] = side == 0   ? i * n
                                         : side == 1 ? i * n + degree
                                         : side == 2 ? i
                                                     : degree * n + i;
  return nodes;
}

Vector2d side_point(int side, double t) {
  switch (side) {
    case 0:
      return {0, t};
    case 1:
      return {1, t};
    case 2:
      return {t, 0};
    default:
      return {t, 1};
  }
}

}  // namespace plastron::fem
