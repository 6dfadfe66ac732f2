// Data of the shell at nodes: position, normal, thickness, and the weight of the nodal quadrature (M21).
// Where regions of different thickness meet, a node has the largest: the thickest part touches an obstacle first (M16).
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/cross_sections.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/fem/surface.hpp>

#include <Eigen/Core>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

struct NodalPoint {
  Eigen::Vector2d x;  ///< parameters in Omega
  Vector3d phi;       ///< position [m]
  Vector3d a3;        ///< unit normal
  double thickness;   ///< e, the largest of the cells that meet [m]
  double young;       ///< E, the largest of the cells that meet [Pa]
  double weight;      ///< nodal quadrature weight: mid-surface area of the node, or 0 [m^2]
};

/// Returns the data of every local node, equal on all ranks that see the node (collective).
std::vector<NodalPoint> nodal_geometry(const fem::Space& space, const fem::Surface& surface,
                                       const element::ElementTables& tables, const CrossSections& sections);

}  // namespace plastron::assembly
