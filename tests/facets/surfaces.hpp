// Surfaces of triangles that tests make: images of a grid, glued together.
#pragma once
#include <plastron/facets/facets.hpp>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace plastron::facets::surfaces {

using geometry::TriangleMesh, geometry::Vector3d;
using std::numbers::pi;

/// Triangles whose points are equal if they are nearer than rounding.
class Builder {
 public:
  int point(const Vector3d& x) {
    const auto rounded = [](double c) { return std::round(c * 1e9) / 1e9 + 0.0; };
    const std::array key{rounded(x[0]), rounded(x[1]), rounded(x[2])};
    const auto [found, is_new] = number_.try_emplace(key, static_cast<int>(mesh_.points.size()));
    if (is_new) mesh_.points.emplace_back(key[0], key[1], key[2]);
    return found->second;
  }
  void triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const std::array corners{point(a), point(b), point(c)};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      mesh_.triangles.push_back(corners);
  }
  /// Adds the image of the unit square, two triangles for each cell.
  template <class Map>
  void grid(int columns, int rows, const Map& map) {
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const auto at = [&](int k, int l) {
          return Vector3d(map(static_cast<double>(i + k) / columns, static_cast<double>(j + l) / rows));
        };
        triangle(at(0, 0), at(1, 0), at(1, 1));
        triangle(at(0, 0), at(1, 1), at(0, 1));
      }
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  TriangleMesh mesh_;
  std::map<std::array<double, 3>, int> number_;
};

/// The unit sphere with circles of latitude; thin triangles at the poles.
inline TriangleMesh sphere(int rows) {
  Builder builder;
  builder.grid(2 * rows, rows, [](double s, double t) {
    return Vector3d(std::sin(pi * t) * std::cos(2 * pi * s), std::sin(pi * t) * std::sin(2 * pi * s),
                    -std::cos(pi * t));
  });
  return builder.take();
}

/// A tube of radius 1 and length 2 along z, as CAD programs write it: triangles from one end to the other.
inline TriangleMesh tube(int columns) {
  Builder builder;
  builder.grid(columns, 1,
               [](double s, double t) { return Vector3d(std::cos(2 * pi * s), std::sin(2 * pi * s), 2 * t); });
  return builder.take();
}

inline TriangleMesh torus(int rows) {
  Builder builder;
  builder.grid(2 * rows, rows, [](double s, double t) {
    const double r = 3 + std::cos(2 * pi * t);
    return Vector3d(r * std::cos(2 * pi * s), r * std::sin(2 * pi * s), std::sin(2 * pi * t));
  });
  return builder.take();
}

inline auto plate(const Vector3d& corner, const Vector3d& side_1, const Vector3d& side_2) {
  return [=](double s, double t) { return Vector3d(corner + s * side_1 + t * side_2); };
}

/// The unit cube, two triangles a face, turned outwards.
inline TriangleMesh cube() {
  Builder builder;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0}) {
      Vector3d corner = Vector3d::Zero(), u = Vector3d::Unit((axis + 1) % 3), v = Vector3d::Unit((axis + 2) % 3);
      corner[axis] = side;
      if (side == 0) std::swap(u, v);
      builder.grid(1, 1, plate(corner, u, v));
    }
  return builder.take();
}

/// Plates of 1 x 1 that leave the y axis at the given angles from the x axis.
inline TriangleMesh star(const std::vector<double>& angles, int cells = 1) {
  Builder builder;
  for (const double a : angles) builder.grid(cells, cells, plate({0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {0, 1, 0}));
  return builder.take();
}

/// A plate of 4 x 4 with a round hole of radius 1/10 and facets of the hole's border.
inline TriangleMesh plate_with_small_hole(int facets) {
  Builder builder;
  builder.grid(facets, 1, [](double s, double t) {
    const double a = 2 * pi * s, c = std::cos(a), d = std::sin(a);
    const double square = 2 / std::max(std::abs(c), std::abs(d));
    const double r = t == 0 ? 0.1 : square;
    return Vector3d(r * c, r * d, 0);
  });
  return builder.take();
}

}  // namespace plastron::facets::surfaces
