// Which of the six rigid motions u = c + w x phi, r = w x a_3 the supports leave free, and what holds those.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/fem/rigid_bodies.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plastron::examination {

/// Coefficients of a rigid motion: a translation [m] and a rotation about the centre of the nodes, times the shell's
/// size [m], so that all six move the shell by about as much.
using RigidMotion = Eigen::Matrix<double, 6, 1>;

class RigidMotions {
 public:
  explicit RigidMotions(const std::vector<assembly::NodalPoint>& points);

  /// What the motions make of a node: u and r times the size, a column for each coefficient.
  Eigen::Matrix<double, 6, 6> at(const assembly::NodalPoint& point) const;
  /// The change of the gap at a node for each coefficient.
  RigidMotion gap_change(const assembly::NodalPoint& point, const obstacle::Gap& gap) const;
  /// Gram matrix of what a rigid body's prescribed components are in the motions.
  Eigen::Matrix<double, 6, 6> held_by(const fem::RigidBody& body) const;
  /// The work of nodal forces and couples (u and r of every node in turn) for each coefficient.
  RigidMotion work(const std::vector<assembly::NodalPoint>& points, std::span<const double> forces) const;

  /// A place after a rotation about the axis of the motion, whose translation along it is left out.
  Eigen::Vector3d turned(const Eigen::Vector3d& place, const RigidMotion& motion, double angle) const;
  static Eigen::Matrix3d turn(const RigidMotion& motion, double angle);
  static bool is_rotation(const RigidMotion& motion);
  double size() const { return size_; }

  /// "translation along ..." or "rotation about the axis ... through ...".
  std::string in_words(const RigidMotion& motion) const;

 private:
  Eigen::Vector3d on_axis(const RigidMotion& motion) const;

  Eigen::Vector3d centre_;
  double size_;
};

/// Bases of the motions that the supports leave free, a column each.
struct FreeMotions {
  Eigen::MatrixXd unheld;            ///< nothing resists them
  Eigen::MatrixXd held_by_obstacle;  ///< the rest: they change the gap, so contact may hold them; orthonormal
};

/// For a mesh that lies on this rank alone.
FreeMotions free_rigid_motions(const RigidMotions& motions, const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates);

/// Columns of a basis put in reduced echelon form, so that pure translations and rotations show as such.
std::vector<RigidMotion> readable(const Eigen::MatrixXd& basis);

}  // namespace plastron::examination
