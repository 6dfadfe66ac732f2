// A system of forces, reduced to a point.
#pragma once
#include <plastron/algebra/vector.hpp>

#include <mpi.h>

#include <Eigen/Geometry>

namespace plastron::solution {

using Eigen::Vector3d;

/// Resultant [N] and moment [N m] about a point, the origin unless the point was moved.
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();

  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    moment += other.moment;
    return *this;
  }
  /// Moves the point by `by`: the moment becomes moment - by x force.
  void move_point(const Vector3d& by) { moment -= by.cross(force); }
};

/// Wrench of the generalised force on (u, r) at a node, a force f at phi and a couple c on the director. Its moment
/// is phi x f + a_3 x c.
inline Wrench nodal_wrench(const Vector3d& phi, const Vector3d& a3, const Eigen::Matrix<double, 6, 1>& f) {
  const Vector3d force = f.head<3>(), couple = f.tail<3>();
  return {force, phi.cross(force) + a3.cross(couple)};
}

/// Sum of all ranks (collective).
inline Wrench over_ranks(const Wrench& w, MPI_Comm comm) {
  Wrench sum;
  for (int k = 0; k < 3; ++k) {
    sum.force[k] = algebra::sum_over_ranks(w.force[k], comm);
    sum.moment[k] = algebra::sum_over_ranks(w.moment[k], comm);
  }
  return sum;
}

}  // namespace plastron::solution
