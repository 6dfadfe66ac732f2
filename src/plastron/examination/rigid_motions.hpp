// The rigid motions u = c + w x phi, r = w x a_3 that the supports leave free, and the contacts that may fix them.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/fem/constraints.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plastron::examination {

/// Coefficients of a rigid motion: a translation [m] and a rotation about the centre of the nodes, times the shell's
/// size [m]. With these units all six move the shell by about the same distance.
using RigidMotion = Eigen::Matrix<double, 6, 1>;

class RigidMotions {
 public:
  explicit RigidMotions(const std::vector<assembly::NodalPoint>& points);

  /// Returns the motion of a node: u and r times the size, one column for each coefficient.
  Eigen::Matrix<double, 6, 6> at(const assembly::NodalPoint& point) const;
  /// Returns the change of the gap at a node for each coefficient.
  RigidMotion gap_change(const assembly::NodalPoint& point, const obstacle::Gap& gap) const;
  /// Returns the Gram matrix of a rigid body's prescribed components as functionals of the motions.
  Eigen::Matrix<double, 6, 6> held_by(const fem::RigidBody& body) const;
  /// Returns the work of nodal forces and couples (u and r of every node in turn) for each coefficient.
  RigidMotion work(const std::vector<assembly::NodalPoint>& points, std::span<const double> forces) const;

  /// Returns a place after a rotation about the axis of the motion, without its translation along the axis.
  Eigen::Vector3d turned(const Eigen::Vector3d& place, const RigidMotion& motion, double angle) const;
  static Eigen::Matrix3d turn(const RigidMotion& motion, double angle);
  static bool is_rotation(const RigidMotion& motion);
  double size() const { return size_; }

  /// Returns "translation along ..." or "rotation about the axis ... through ...".
  std::string in_words(const RigidMotion& motion) const;

 private:
  Eigen::Vector3d on_axis(const RigidMotion& motion) const;

  Eigen::Vector3d centre_;
  double size_;
};

/// Bases of the motions that the supports leave free, one motion in each column.
struct FreeMotions {
  Eigen::MatrixXd unheld;            ///< nothing resists them
  Eigen::MatrixXd held_by_obstacle;  ///< the others: they change the gap, so contact may fix them; orthonormal
};

/// Returns the free motions, for a mesh that is on this rank alone.
FreeMotions free_rigid_motions(const RigidMotions& motions, const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates);

/// Returns the columns of a basis in reduced echelon form, which shows pure translations and rotations.
std::vector<RigidMotion> readable(const Eigen::MatrixXd& basis);

}  // namespace plastron::examination
