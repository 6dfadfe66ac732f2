#include <plastron/mesh/surface_patches.hpp>

#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::mesh {

namespace {

using geometry::Vector3d;

/// Sums of a polynomial and its derivatives along the patch's coordinates.
struct PatchSum {
  Vector3d phi = Vector3d::Zero(), director = Vector3d::Zero();
  std::array<Vector3d, 2> tangents{Vector3d::Zero(), Vector3d::Zero()};
  std::array<Vector3d, 2> director_derivatives{Vector3d::Zero(), Vector3d::Zero()};

  void add(double value, const Vector2d& d, const Vector3d& position, const Vector3d& direction) {
    phi += value * position;
    director += value * direction;
    for (std::size_t a = 0; a < 2; ++a) {
      tangents[a] += d[static_cast<Eigen::Index>(a)] * position;
      director_derivatives[a] += d[static_cast<Eigen::Index>(a)] * direction;
    }
  }
};

PatchSum sum_at(const SurfacePatches& surface, const SurfacePatches::Patch& patch, const Vector2d& xi) {
  const LatticeValues basis = lattice_values(surface.shape, patch.order, xi);
  PatchSum sum;
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const auto node = static_cast<std::size_t>(patch.nodes[i]);
    sum.add(basis.value[at], {basis.d[0][at], basis.d[1][at]}, surface.positions[node], surface.directors[node]);
  }
  return sum;
}

}  // namespace

geometry::Frame SurfacePatches::frame(int patch, const PlaneJet& at) const {
  const PatchSum sum = sum_at(*this, patches[static_cast<std::size_t>(patch)], at.value);
  const auto along = [&](const std::array<Vector3d, 2>& d) {
    return std::array<Vector3d, 2>{d[0] * at.d[0][0] + d[1] * at.d[0][1], d[0] * at.d[1][0] + d[1] * at.d[1][1]};
  };
  return geometry::frame_with_director(sum.phi, along(sum.tangents), sum.director, along(sum.director_derivatives));
}

Vector3d SurfacePatches::first_tangent(const geometry::Frame& frame) const {
  constexpr double nearly_normal = 10;  // degrees between axis and normal
  static const double least = std::sin(nearly_normal * std::acos(-1) / 180);
  const Vector3d normal = geometry::surface_normal(frame);
  const Vector3d first = geometry::tangential(axes[0], normal);
  return first.norm() > least ? first : geometry::tangential(axes[1], normal);
}

void choose_axes(SurfacePatches& surface) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector3d& position : surface.positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const Vector3d extent = high - low;
  std::array order{0, 1, 2};
  // Extents that differ by rounding count as equal, so that a file in other units has the same axes.
  const double equal = 1e-6 * extent.maxCoeff();
  std::ranges::stable_sort(order, [&](int a, int b) { return extent[a] > extent[b] + equal; });
  for (std::size_t k = 0; k < 2; ++k) surface.axes[k] = Vector3d::Unit(order[k]);
}

}  // namespace plastron::mesh
