// A system of forces, reduced to a point.
#pragma once
#include <mpi.h>

#include <Eigen/Core>

namespace plastron::certificate {

using Eigen::Vector3d;

/// Resultant [N] and moment about a point, the origin unless it was moved [N m].
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();

  Wrench& operator+=(const Wrench& other);
  /// The moment becomes that about a point which lies `by` from the one before: moment - by x force.
  void move_point(const Vector3d& by);
};

/// Of what works on (u, r) at a node: a force at phi and a couple on the director, phi x f + a_3 x c.
Wrench nodal_wrench(const Vector3d& phi, const Vector3d& a3, const Eigen::Matrix<double, 6, 1>& f);
/// The sum (collective).
Wrench over_ranks(const Wrench& w, MPI_Comm comm);

}  // namespace plastron::certificate
