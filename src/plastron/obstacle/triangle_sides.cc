#include <plastron/obstacle/triangle_sides.hpp>

#include <algorithm>
#include <tuple>

namespace plastron::obstacle {

std::vector<TriangleSide> sorted_sides(const TriangleMesh& mesh) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  std::ranges::sort(sides, [](const TriangleSide& p, const TriangleSide& q) {
    return std::tie(p.low, p.high, p.triangle) < std::tie(q.low, q.high, q.triangle);
  });
  return sides;
}

}  // namespace plastron::obstacle
