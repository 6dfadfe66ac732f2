// The rigid motions u = c + w x phi, r = w x a_3 that the supports leave free, and the contacts that may fix them.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/energy/term.hpp>
#include <plastron/fem/rigid_body.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plastron::examination {

/// Coefficients of a rigid motion: a translation [m] and a rotation about the centre of the nodes, times the shell's
/// size [m]. With these units all six move the shell by about the same distance.
using RigidMotion = Eigen::Matrix<double, 6, 1>;

/// A connected part of the shell, on a mesh that is on this rank alone.
struct ShellPart {
  std::vector<std::size_t> nodes{};              ///< ascending
  std::vector<assembly::NodalPoint> points{};    ///< of these nodes
  std::vector<const fem::PlacedBody*> bodies{};  ///< that carry some of these nodes
};

/// Returns the parts, by their first nodes. Cells are connected by common nodes, joined edges, folds, rigid bodies and, if wished,
/// hinges.
std::vector<ShellPart> parts_of(const fem::Space& space, const std::vector<assembly::NodalPoint>& points,
                                bool through_hinges = true);

class RigidMotions {
 public:
  explicit RigidMotions(const std::vector<assembly::NodalPoint>& points);

  /// Returns the motion of a node: u and r times the size, one column for each coefficient.
  Eigen::Matrix<double, 6, 6> at(const assembly::NodalPoint& point) const;
  /// Returns the change of the gap at a node for each coefficient.
  RigidMotion gap_change(const assembly::NodalPoint& point, const obstacle::Gap& gap) const;
  /// Returns the Gram matrix of a rigid body's prescribed components as functionals of the motions.
  Eigen::Matrix<double, 6, 6> fixed_by(const fem::RigidBody& body) const;
  /// Returns the forces of a term of the potential for the motion of the part with coefficient k = 1, at all nodes of the mesh.
  algebra::Vector forces_of(const energy::Term& term, const energy::ShellOperator& shell, const ShellPart& part,
                            int k) const;
  /// Returns v' K w for the motions v, w of the part and a term of the potential, as a part of the largest one.
  Eigen::Matrix<double, 6, 6> stiffness_of(const energy::Term& term, const energy::ShellOperator& shell,
                                           const ShellPart& part) const;
  /// Returns the work of nodal forces and couples (u and r of every node of the mesh in turn) on the part, for each
  /// coefficient.
  RigidMotion work(const ShellPart& part, std::span<const double> forces) const;

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

/// Returns the free motions of the part. `motions` are those of its points; `terms` resist motions, too.
FreeMotions free_rigid_motions(const RigidMotions& motions, const ShellPart& part,
                               const assembly::NodalCoordinates& coordinates, const energy::ShellOperator& shell,
                               const energy::Terms& terms);

/// Returns the motions of pieces against each other at hinges that nothing resists, neither terms nor contact. `pieces`: those of one
/// part without its hinges; `motions`: those of the part.
std::vector<RigidMotion> free_hinge_motions(const RigidMotions& motions, const std::vector<ShellPart>& pieces,
                                            const assembly::NodalCoordinates& coordinates,
                                            const energy::ShellOperator& shell, const energy::Terms& terms);

/// Returns the columns of a basis in reduced echelon form, which shows pure translations and rotations.
std::vector<RigidMotion> readable(const Eigen::MatrixXd& basis);

// The loads must press the shell onto the obstacle where only the obstacle fixes it. The energy must not decrease without
// limit along any rigid motion W that the supports leave free and that closes no gap: l(W) <= 0. By Farkas' lemma this
// is true if and only if reactions eta >= 0 balance the loads: -l = G' eta on the free motions.

enum class Hold {
  pressed,   ///< the energy grows along every such motion
  balanced,  ///< the energy is constant along some motion: the loads just do not pull the shell off, or do no work
  pulled_off
};

struct Pressing {
  Hold hold = Hold::pressed;
  RigidMotion motion = RigidMotion::Zero();  ///< unit length: the motion that is not pressed; it opens the gap
};

/// Checks the loads on a part. `held` is an orthonormal basis of motions that the supports leave free, `forces` are
/// nodal forces and couples of the whole mesh.
Pressing pressing(const RigidMotions& motions, const Eigen::MatrixXd& held, const ShellPart& part,
                  const assembly::NodalCoordinates& coordinates, std::span<const double> forces);

/// Solves a least squares problem with non-negative coefficients, for few rows: min |b - A x| over x >= 0
/// (C. L. Lawson, R. J. Hanson: Solving least squares problems, chapter 23).
/// Returns the residual b - A x of the best x. By Farkas' lemma it is zero, or a direction r with A' r <= 0 and
/// b . r > 0.
Eigen::VectorXd nonnegative_residual(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace plastron::examination
