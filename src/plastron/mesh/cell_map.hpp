// The exact map of a coarse cell: the reference cell onto a piece of Omega, with two derivatives; and its inverse.
#pragma once
#include <plastron/geometry/jet.hpp>
#include <plastron/mesh/reference_cell.hpp>

#include <array>
#include <optional>
#include <variant>
#include <vector>

namespace plastron::mesh {

using geometry::PlaneJet;

/// Value and two derivatives of a curve over [0, 1].
struct CurveJet {
  Vector2d value, d, dd;
};

struct Segment {
  Vector2d from, to;
  CurveJet operator()(double t) const;
};

/// Part of a circle; the angle runs linearly from angle_from to angle_to [rad].
struct Arc {
  Vector2d centre;
  double radius;
  double angle_from, angle_to;
  CurveJet operator()(double t) const;
};

using Edge = std::variant<Segment, Arc>;

/// Transfinite interpolation between four edges (Gordon and Hall 1973): it reproduces every edge exactly.
struct BlendedMap {
  Edge left, right;  ///< edges xi_1 = 0 and 1, parametrised by xi_2
  Edge bottom, top;  ///< edges xi_2 = 0 and 1, parametrised by xi_1
  PlaneJet operator()(const Vector2d& xi) const;
};

/// Tensor-product polynomial through (order + 1)^2 equidistant nodes, xi_1 fastest.
struct LagrangeMap {
  int order = 1;
  std::vector<Vector2d> nodes;
  PlaneJet operator()(const Vector2d& xi) const;
};

/// Polynomial on the reference triangle through (order + 1)(order + 2) / 2 equidistant nodes, xi_1 fastest.
struct TriangleLagrangeMap {
  int order = 1;
  std::vector<Vector2d> nodes;
  PlaneJet operator()(const Vector2d& xi) const;
};

using ExactMap = std::variant<BlendedMap, LagrangeMap, TriangleLagrangeMap>;

/// An exact map composed with an affine map of its parameters: xi_map = origin + axes * xi. The affine map is a
/// rotation or reflection of the unit square, or the map of the triangle onto a part of it.
struct CellMap {
  ExactMap map;
  Vector2d origin = Vector2d::Zero();
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
  PlaneJet operator()(const Vector2d& xi) const;
};

/// Finds the point of the reference cell for a point of the plane, by Newton's method from the centre. Empty if the
/// point lies outside the cell by more than rounding.
std::optional<Vector2d> invert_map(Shape shape, const CellMap& map, const Vector2d& point);

}  // namespace plastron::mesh
