// Loads of (M9) as functions of the parameters x, y.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace plastron::assembly {

using VectorExpression = std::array<geometry::Expression, 3>;
/// A load that a program computes itself, as a function of x and y.
using VectorFunction = std::function<Eigen::Vector3d(double x, double y)>;

/// Dead load per unit mid-surface area, on the whole surface or on some of its regions.
struct AreaLoad {
  VectorExpression force{};            ///< p, Cartesian [N/m^2]
  geometry::Expression pressure{};     ///< force along a_3, positive along the normal [N/m^2]
  VectorExpression couple{};           ///< m, does work on r [N m/m^2]
  VectorFunction force_function{};     ///< added to `force`; empty in loads from case files
  VectorFunction couple_function{};    ///< added to `couple`
  std::vector<std::string> regions{};  ///< regions where the load acts; empty: everywhere

  bool acts_in(const std::string& region) const {
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }
};

/// Dead load per unit length of the curve phi(Gamma), on the boundary or inside the shell.
struct EdgeLoad {
  std::string boundary{};
  VectorExpression force{};   ///< n [N/m]
  VectorExpression couple{};  ///< k, does work on r [N m/m]
};

}  // namespace plastron::assembly
