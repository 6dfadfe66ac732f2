#include <plastron/io/thinned_surface.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace plastron::io {

namespace {

using Eigen::Vector3d;
using obstacle::TriangleMesh;

TriangleMesh clustered(const TriangleMesh& surface, const Vector3d& low, double box) {
  TriangleMesh result;
  std::map<std::array<long long, 3>, int> number_of;
  std::vector<int> number;
  for (const Vector3d& p : surface.points) {
    const Vector3d place = (p - low) / box;
    const auto [entry, is_new] = number_of.try_emplace(
        {std::llround(std::floor(place[0])), std::llround(std::floor(place[1])), std::llround(std::floor(place[2]))},
        static_cast<int>(result.points.size()));
    if (is_new) result.points.push_back(p);
    number.push_back(entry->second);
  }
  for (const auto& [a, b, c] : surface.triangles) {
    const std::array<int, 3> corners{number[static_cast<std::size_t>(a)], number[static_cast<std::size_t>(b)],
                                     number[static_cast<std::size_t>(c)]};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

TriangleMesh thinned_surface(const TriangleMesh& surface, std::size_t most) {
  if (surface.triangles.size() <= most) return surface;
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Vector3d& p : surface.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  TriangleMesh result;
  for (const int boxes : {96, 48, 24, 12}) {
    result = clustered(surface, low, (high - low).maxCoeff() * (1 + 1e-12) / boxes);
    if (result.triangles.size() <= most) break;
  }
  return result;
}

}  // namespace plastron::io
