// What the nodes need to know of the surface: position, normal, thickness, and the weight of the nodal quadrature
// (M21).
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/geometry/expression.hpp>

#include <Eigen/Core>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

struct NodalPoint {
  Eigen::Vector2d x;  ///< parameters in Omega
  Vector3d phi;       ///< position [m]
  Vector3d a3;        ///< unit normal
  double thickness;   ///< e [m]
  double weight;      ///< nodal quadrature weight: mid-surface area that the node stands for, or 0 [m^2]
};

/// Of every local node, the same on every rank that sees the node (collective).
std::vector<NodalPoint> nodal_geometry(const fem::Space& space, const fem::Surface& surface,
                                       const element::ElementTables& tables, const geometry::Expression& thickness);

}  // namespace plastron::assembly
