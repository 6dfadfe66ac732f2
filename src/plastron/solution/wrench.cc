#include <plastron/solution/wrench.hpp>

#include <plastron/algebra/vector.hpp>

#include <Eigen/Geometry>

namespace plastron::solution {

Wrench& Wrench::operator+=(const Wrench& other) {
  force += other.force;
  moment += other.moment;
  return *this;
}

void Wrench::move_point(const Vector3d& by) { moment -= by.cross(force); }

Wrench nodal_wrench(const Vector3d& phi, const Vector3d& a3, const Eigen::Matrix<double, 6, 1>& f) {
  const Vector3d force = f.head<3>(), couple = f.tail<3>();
  return {force, phi.cross(force) + a3.cross(couple)};
}

Wrench over_ranks(const Wrench& w, MPI_Comm comm) {
  Wrench sum;
  for (int k = 0; k < 3; ++k) {
    sum.force[k] = algebra::sum_over_ranks(w.force[k], comm);
    sum.moment[k] = algebra::sum_over_ranks(w.moment[k], comm);
  }
  return sum;
}

}  // namespace plastron::solution
