// The largest and smallest stresses of each layer of a laminate, in the layer's own axes.
#pragma once
#include <plastron/recovery/recovery.hpp>
#include <plastron/recovery/singular_places.hpp>

#include <span>
#include <string>
#include <vector>

namespace plastron::recovery {

/// A stress and its place.
struct PlacedStress {
  double stress = 0;                                   ///< [Pa]
  double height = 0;                                   ///< height z of the stress along a_3 [m]
  Eigen::Vector2d x = Eigen::Vector2d::Zero();         ///< parameters in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< point on the undeformed mid-surface [m]
};

/// One component of the stress in one layer.
struct LayerStress {
  std::string region{};     ///< name of the region
  int layer = 0;            ///< number of the layer from the lower face, from 1 on
  double angle = 0;         ///< from the laminate's axis 1 to the layer's [degrees]
  std::string component{};  ///< 11, 22, 12, 13, 23 in the layer's axes 1, 2 and the normal 3
  PlacedStress most{}, least{};
};

/// Searches equidistant points of all cells outside the radius of all singular places, as stress_peak() does; in each
/// layer at the lower and upper interface, transverse shear also in the middle. Lists five components of each layer of
/// each region with a laminate (collective).
std::vector<LayerStress> layer_stresses(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                        const Choice& choice, std::span<const SingularPlace> singular);

}  // namespace plastron::recovery
