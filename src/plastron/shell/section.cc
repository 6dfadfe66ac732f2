#include <plastron/shell/section.hpp>

#include <Eigen/Cholesky>

#include <cmath>

namespace plastron::shell {

Eigen::Matrix<double, 6, 6> Section::in_plane() const {
  Eigen::Matrix<double, 6, 6> c;
  c << membrane, coupling, coupling, bending;
  return c;
}

bool Section::is_coupled() const { return (coupling.array() != 0).any(); }

bool Section::has_initial_strains() const {
  return (initial_force.array() != 0).any() || (initial_moment.array() != 0).any();
}

Vector8 Section::resultants_of(const Vector8& strains) const {
  Vector8 n;
  n << membrane * strains.head<3>(), bending * strains.segment<3>(3), shear * strains.tail<2>();
  if (is_coupled()) {
    n.head<3>() += coupling * strains.segment<3>(3);
    n.segment<3>(3) += coupling * strains.head<3>();
  }
  return n;
}

Vector8 Section::strains_of(const Vector8& resultants) const {
  Vector8 e;
  if (is_coupled())
    e.head<6>() = in_plane().llt().solve(resultants.head<6>());
  else
    e.head<6>() << membrane.llt().solve(resultants.head<3>()), bending.llt().solve(resultants.segment<3>(3));
  e.tail<2>() = shear.llt().solve(resultants.tail<2>());
  return e;
}

Vector8 Section::initial_resultants() const {
  Vector8 n = Vector8::Zero();
  n << initial_force, initial_moment, 0, 0;
  return n;
}

Eigen::Matrix3d Section::bending_without_force() const {
  return is_coupled() ? Eigen::Matrix3d(bending - coupling * membrane.llt().solve(coupling)) : bending;
}

double bending_length(const Section& s) { return std::sqrt(s.bending_without_force()(0, 0) / s.shear(0, 0)); }

double twist_length(const Section& s) { return std::sqrt(s.bending_without_force()(2, 2) / s.shear(1, 1)); }

EnergyDensity energy_density(const Section& c, const Strain<double>& s) {
  const Resultants<double> n = resultants(c, s);
  return {s.membrane.dot(n.membrane) / 2, s.bending.dot(n.bending) / 2, s.shear.dot(n.shear) / 2};
}

}  // namespace plastron::shell
