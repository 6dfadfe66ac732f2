// A system of forces, reduced to the origin.
#pragma once
#include <mpi.h>

#include <Eigen/Core>

namespace plastron::certificate {

using Eigen::Vector3d;

/// Resultant [N] and moment about the origin [N m].
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();

  Wrench& operator+=(const Wrench& other);
};

/// Of what works on (u, r) at a node: a force at phi and a couple on the director, phi x f + a_3 x c.
Wrench nodal_wrench(const Vector3d& phi, const Vector3d& a3, const Eigen::Matrix<double, 6, 1>& f);
/// The sum (collective).
Wrench over_ranks(const Wrench& w, MPI_Comm comm);

}  // namespace plastron::certificate
