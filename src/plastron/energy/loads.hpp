// Loads of (M9) as functions of the parameters x, y.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::energy {

/// Error of a load, a foundation or a temperature, in words for the user: it is infinite or not a number at a quadrature point, or
/// names a boundary or region that the mesh does not have.
struct LoadError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

using VectorExpression = std::array<geometry::Expression, 3>;
/// A load that a program computes itself, as a function of x and y.
using VectorFunction = std::function<Eigen::Vector3d(double x, double y)>;

struct Loads;

/// Load per unit mid-surface area, dead unless it follows, on the whole surface or on some of its regions.
struct AreaLoad {
  VectorExpression force{};            ///< p, Cartesian [N/m^2]
  geometry::Expression pressure{};     ///< force along a_3, positive along the normal [N/m^2]
  bool follows = false;                ///< with finite rotations `pressure` acts on the deformed surface
  VectorExpression couple{};           ///< m, does work on r [N m/m^2]
  VectorFunction force_function{};     ///< added to `force`; empty in loads from case files
  VectorFunction couple_function{};    ///< added to `couple`
  std::vector<std::string> regions{};  ///< regions where the load acts; empty: everywhere
  geometry::Expression where{1.0};     ///< the load acts at places where this is not 0
  int factor = -1;                     ///< see Factors::named

  bool acts_in(const std::string& region) const {
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }
};

/// Dead load per unit length of the curve phi(Gamma), on the boundary or inside the shell.
struct EdgeLoad {
  std::string boundary{};
  VectorExpression force{};         ///< n [N/m]
  VectorExpression couple{};        ///< k, does work on r [N m/m]
  geometry::Expression where{1.0};  ///< the load acts at places where this is not 0
  int factor = -1;                  ///< see Factors::named
};

/// A point in space and the places of the shell that are nearer to it than a radius.
struct Spot {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double radius = 0;

  /// Returns 1 inside and 0 outside, as an expression of X, Y, Z.
  geometry::Expression inside() const;
};

/// Dead force F and moment M of known sums, spread over an area or, if boundaries are named, over a length. The force per area is
/// F / A + omega x (X - c): c is the centroid, A the area, and omega gives the moment M about c.
struct TotalForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [N m]
  std::vector<std::string> boundaries{};
  std::vector<std::string> regions{};  ///< empty: everywhere
  geometry::Expression where{1.0};     ///< the load acts at places where this is not 0
  std::optional<Spot> spot{};          ///< the load acts inside this alone, and `where` is not used
  int factor = -1;                     ///< see Factors::named

  /// Returns the loads of a force per area or length at its place.
  Loads spread(const VectorExpression& density) const;
};

/// Where a load acts: on a boundary or, if that is empty, on regions.
struct LoadPlace {
  std::string boundary{};
  std::vector<std::string> regions{};  ///< empty: everywhere
};

/// All loads of a shell at load factor 1, without those of rigid bodies.
struct Loads {
  std::vector<AreaLoad> on_areas{};
  std::vector<EdgeLoad> on_edges{};
  std::vector<TotalForce> totals{};
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration g for the weight of the density [m/s^2]
  int gravity_factor = -1;                            ///< see Factors::named

  bool empty() const { return on_areas.empty() && on_edges.empty() && totals.empty() && gravity.isZero(0); }
  /// Receives an expression, its name in messages such as "the z component of a load's force", and its place.
  using Visit = std::function<void(const geometry::Expression& f, const std::string& name, const LoadPlace& place)>;
  void for_each_expression(const Visit& visit) const;
  /// Returns the names that the loads use, once for each use.
  std::vector<std::string> region_names() const;
  std::vector<std::string> boundary_names() const;
  /// Returns the loads that have this factor.
  Loads of(int factor) const;
  /// Multiplies all loads by a factor.
  void scale(double factor);
};

}  // namespace plastron::energy
