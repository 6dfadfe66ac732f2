// A system of forces, reduced to a point.
#pragma once
#include <mpi.h>

#include <Eigen/Core>

namespace plastron::solution {

using Eigen::Vector3d;

/// Resultant [N] and moment [N m] about a point, the origin unless the point was moved.
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();

  Wrench& operator+=(const Wrench& other);
  /// Moves the point by `by`: the moment becomes moment - by x force.
  void move_point(const Vector3d& by);
};

/// Wrench of the generalised force on (u, r) at a node, a force f at phi and a couple c on the director. Its moment
/// is phi x f + a_3 x c.
Wrench nodal_wrench(const Vector3d& phi, const Vector3d& a3, const Eigen::Matrix<double, 6, 1>& f);
/// Sum of all ranks (collective).
Wrench over_ranks(const Wrench& w, MPI_Comm comm);

}  // namespace plastron::solution
