// Data of the shell at nodes: position, normal, thickness, and the weight of the nodal quadrature (M21).
// Where regions of different thickness meet, a node has the largest: the thickest part touches an obstacle first (M16).
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/energy/cross_sections.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/obstacle/gap.hpp>

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

struct NodalPoint {
  Eigen::Vector2d x;       ///< parameters in Omega
  Vector3d phi;            ///< position [m]
  Vector3d a3;             ///< unit normal, or director (geometry::Frame)
  double thickness;        ///< e, the largest of the cells that meet [m]
  double young;            ///< E, the largest of the cells that meet [Pa]
  double weight;           ///< nodal quadrature weight: mid-surface area of the node, or 0 [m^2]
  double side_weight = 0;  ///< the same of the node's own side of a fold; elsewhere `weight` [m^2]
};

/// Returns the data of every local node, equal on all ranks that see the node (collective).
std::vector<NodalPoint> nodal_geometry(const fem::Space& space, const fem::Surface& surface,
                                       const element::ElementTables& tables, const energy::CrossSections& sections);

/// Returns (phi, a_3) of the nodes, equal where nodes are equal (block 6).
algebra::Vector places_and_directors(const fem::Space& space, const std::vector<NodalPoint>& points);

/// Returns the reaches of all local nodes, from the nodes of the cells around them. Empty if no obstacle has edges (collective).
std::vector<obstacle::Reach> reaches_of(const fem::Space& space, const std::vector<NodalPoint>& points,
                                        const std::vector<obstacle::Obstacle>& obstacles);

/// An axis-parallel box.
struct BoundingBox {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;

  double half_diagonal() const { return (high - low).norm() / 2; }
  double longest_side() const { return (high - low).maxCoeff(); }
};

/// Returns the box around place(0), ..., place(count - 1) of all ranks (collective).
template <class Place>
BoundingBox bounding_box(std::size_t count, const Place& place, MPI_Comm comm) {
  BoundingBox box;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d at = place(i);
    box.low = box.low.cwiseMin(at);
    box.high = box.high.cwiseMax(at);
  }
  for (int k = 0; k < 3; ++k) {
    box.low[k] = algebra::min_over_ranks(box.low[k], comm);
    box.high[k] = algebra::max_over_ranks(box.high[k], comm);
  }
  return box;
}

}  // namespace plastron::assembly
