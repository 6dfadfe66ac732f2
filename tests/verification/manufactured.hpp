// Two exact solutions of Naghdi's model on a curved chart over the unit square, and the loads that belong to them:
// one clamped without an obstacle, one pressed on the plane x3 = 0 with the known free boundary B(x, y) = 1.
// The loads come from the strong form of (M8, M9, M16) by exact Taylor arithmetic, independently of shell/.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>

namespace plastron::verification {

using Eigen::Vector3d;

enum class ManufacturedSolution { clamped, contact };

struct ManufacturedShell {
  double E = 1;  ///< [Pa]
  double nu = 0.3;
  double thickness = 0.1;       ///< e [m]
  double shear_correction = 1;  ///< k_s
};

/// A vector field at a point with its derivatives along x and y.
struct ExactField {
  Vector3d value;
  std::array<Vector3d, 2> d;
};

/// Loads per unit mid-surface area, without the reaction of the obstacle.
struct ExactLoad {
  Vector3d force;   ///< f [N/m^2]
  Vector3d couple;  ///< m [N m/m^2]; with its part along a_3, so that the balance holds for s that are not tangent too
};

class Manufactured {
 public:
  Manufactured(ManufacturedSolution solution, const ManufacturedShell& shell) : solution_(solution), shell_(shell) {}

  /// The chart as expressions in x, y over (0, 1)^2.
  static std::array<std::string, 3> chart();

  ExactField u(double x, double y) const;
  ExactField r(double x, double y) const;
  ExactLoad load(double x, double y) const;
  Vector3d force(double x, double y) const { return load(x, y).force; }
  Vector3d couple(double x, double y) const { return load(x, y).couple; }

  /// Gap of the lower face over x3 = 0 [m]. Without an obstacle it is only that height.
  double gap(double x, double y) const;
  /// Reaction of the obstacle per unit mid-surface area [Pa]; 0 without an obstacle.
  double eta(double x, double y) const;
  /// B(x, y): the shell touches where B >= 1 (contact solution only).
  static double contact_function(double x, double y);

  ManufacturedSolution solution() const { return solution_; }
  const ManufacturedShell& shell() const { return shell_; }

 private:
  ManufacturedSolution solution_;
  ManufacturedShell shell_;
};

}  // namespace plastron::verification
