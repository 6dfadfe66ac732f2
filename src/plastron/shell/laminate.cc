#include <plastron/shell/laminate.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::shell {

namespace {

using Eigen::Matrix2d, Eigen::Matrix3d;

/// Maps (eps_11, eps_22, 2 eps_12) to the same in axes whose components are the rows of `axes`. Its transpose maps
/// stresses back.
Matrix3d strain_map(const Matrix2d& axes) {
  const auto row = [&](int i, int j) {
    return Eigen::RowVector3d(axes(i, 0) * axes(j, 0), axes(i, 1) * axes(j, 1),
                              (axes(i, 0) * axes(j, 1) + axes(i, 1) * axes(j, 0)) / 2);
  };
  Matrix3d map;
  map << row(0, 0), row(1, 1), 2 * row(0, 1);
  return map;
}

Matrix2d turned(double angle) {
  Matrix2d turn;
  turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  return turn;
}

std::vector<double> interfaces_of(const std::vector<Layer>& layers) {
  double sum = 0;
  for (const Layer& layer : layers) sum += layer.part;
  std::vector<double> z{-0.5};
  for (const Layer& layer : layers) z.push_back(z.back() + layer.part / sum);
  z.back() = 0.5;
  return z;
}

/// Returns the cross-section of thickness 1 in the laminate's axes.
Section unit_section(const std::vector<Layer>& layers, const std::vector<double>& z) {
  Section s{.membrane = Matrix3d::Zero(), .bending = Matrix3d::Zero(), .shear = Matrix2d::Zero()};
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Layer& layer = layers[k];
    const Matrix2d axes = turned(layer.angle);
    const Matrix3d map = strain_map(axes), c = map.transpose() * layer.material.in_plane() * map;
    const Vector3d initial = map.transpose() * (layer.material.in_plane() * layer.strain);
    const double height = z[k + 1] - z[k], middle = (z[k] + z[k + 1]) / 2;
    s.membrane += height * c;
    s.coupling += height * middle * c;
    s.bending += height * (middle * middle + height * height / 12) * c;
    s.shear +=
        height * (axes.transpose() * Eigen::Vector2d(layer.material.G13, layer.material.G23).asDiagonal() * axes);
    s.initial_force += height * initial;
    s.initial_moment += height * middle * initial;
  }
  return s;
}

template <class Value>
double mean_over(const std::vector<Layer>& layers, const Value& value) {
  double sum = 0, parts = 0;
  for (const Layer& layer : layers) {
    sum += layer.part * value(layer.material);
    parts += layer.part;
  }
  return sum / parts;
}

}  // namespace

bool Orthotropic::is_positive_definite() const {
  return std::min({E1, E2, G12, G13, G23}) > 0 && nu12 * nu12 * E2 < E1;
}

Matrix3d Orthotropic::in_plane() const {
  const double common = 1 - nu12 * nu12 * E2 / E1;
  Matrix3d c = Matrix3d::Zero();
  c(0, 0) = E1 / common;
  c(1, 1) = E2 / common;
  c(0, 1) = c(1, 0) = nu12 * E2 / common;
  c(2, 2) = G12;
  return c;
}

Laminate::Laminate(std::vector<Layer> layers, const Vector3d& direction)
    : layers_(std::move(layers)),
      interfaces_(interfaces_of(layers_)),
      direction_(direction.normalized()),
      unit_(unit_section(layers_, interfaces_)) {}

double Laminate::young() const {
  return mean_over(layers_, [](const Orthotropic& m) { return (m.E1 + m.E2) / 2; });
}

double Laminate::shear_modulus() const {
  return mean_over(layers_, [](const Orthotropic& m) { return (m.G13 + m.G23) / 2; });
}

bool Laminate::has_axes(const Vector3d& a3) const {
  constexpr double least_sine = 0.01;
  return geometry::tangential(direction_, a3).norm() >= least_sine;
}

Matrix2d Laminate::axes(const geometry::Frame& frame) const {
  const Vector3d t1 = geometry::tangential(direction_, frame.a3).normalized(), t2 = frame.a3.cross(t1);
  Matrix2d axes;
  axes << t1.dot(frame.a_con[0]), t1.dot(frame.a_con[1]), t2.dot(frame.a_con[0]), t2.dot(frame.a_con[1]);
  return axes;
}

Section Laminate::section(const Matrix2d& axes, double thickness, double shear_correction) const {
  const double e = thickness;
  const Matrix3d map = strain_map(axes);
  return {.membrane = e * (map.transpose() * unit_.membrane * map),
          .bending = e * e * e * (map.transpose() * unit_.bending * map),
          .shear = shear_correction * e * (axes.transpose() * unit_.shear * axes),
          .coupling = e * e * (map.transpose() * unit_.coupling * map),
          .initial_force = e * (map.transpose() * unit_.initial_force),
          .initial_moment = e * e * (map.transpose() * unit_.initial_moment)};
}

LaminateSection::LaminateSection(std::shared_ptr<const Laminate> laminate, const geometry::Frame& axes,
                                 double thickness, double shear_correction, double load_factor)
    : laminate_(std::move(laminate)),
      thickness_(thickness),
      section_(laminate_->section(laminate_->axes(axes), thickness, shear_correction)),
      compliance_(section_.in_plane().llt().solve(Eigen::Matrix<double, 6, 6>::Identity())) {
  section_.initial_force *= load_factor;
  section_.initial_moment *= load_factor;
  const Matrix2d first = laminate_->axes(axes);
  Matrix2d shear = Matrix2d::Zero();
  for (std::size_t k = 0; k < laminate_->layers().size(); ++k) {
    const Layer& layer = laminate_->layers()[k];
    const Matrix2d own = turned(layer.angle) * first;
    const Matrix3d map = strain_map(own), c = layer.material.in_plane();
    const Ply& ply = plies_.emplace_back(Ply{.stiffness = map.transpose() * c * map,
                                             .initial_stress = load_factor * (map.transpose() * (c * layer.strain)),
                                             .axes = own,
                                             .shear_at_interface = shear});
    shear += shear_gain(ply, interface(k), interface(k + 1));
  }
}

std::size_t LaminateSection::layer_at(double z) const {
  // Above the mid-surface an interface belongs to the layer below it, elsewhere to the layer above.
  std::size_t k = 0;
  while (k + 1 < layer_count() && (z > interface(k + 1) || (z == interface(k + 1) && z <= 0))) ++k;
  return k;
}

// If only Q_1 acts, then d_1 M_11 = Q_1, and no other resultant changes: the strains change by column 11 of the bending
// part of the compliance. Equilibrium d_1 sigma_1a + d_3 sigma_a3 = 0 gives the shear stress by integration over z.
Matrix2d LaminateSection::shear_gain(const Ply& ply, double from, double to) const {
  Matrix2d gain;
  for (int a = 0; a < 2; ++a) {
    const Vector3d gamma = compliance_.col(3 + a).head<3>(), chi = compliance_.col(3 + a).tail<3>();
    const Vector3d stress = ply.stiffness * ((to - from) * gamma + (to * to - from * from) / 2 * chi);
    gain(a, a) = -stress[a];
    gain(1 - a, a) = -stress[2];
  }
  return gain;
}

StressMap LaminateSection::stress(std::size_t layer, double z) const {
  const Ply& ply = plies_[layer];
  StressMap s;
  s.map.topLeftCorner<3, 6>() = ply.stiffness * (compliance_.topRows<3>() + z * compliance_.bottomRows<3>());
  s.map.bottomRightCorner<2, 2>() = ply.shear_at_interface + shear_gain(ply, interface(layer), z);
  s.constant.head<3>() = s.map.topLeftCorner<3, 6>() * section_.initial_resultants().head<6>() - ply.initial_stress;
  return s;
}

StressMap LaminateSection::stress_in_layer_axes(std::size_t layer, double z) const {
  const Matrix2d& axes = plies_[layer].axes;
  Eigen::Matrix<double, 5, 5> turn = Eigen::Matrix<double, 5, 5>::Zero();
  // sigma_ij = axes sigma axes'; in orthonormal axes this is the inverse transpose of the map of strains.
  turn.topLeftCorner<3, 3>() = strain_map(axes.transpose()).transpose();
  turn.bottomRightCorner<2, 2>() = axes;
  const StressMap s = stress(layer, z);
  return {.map = turn * s.map, .constant = turn * s.constant};
}

}  // namespace plastron::shell
