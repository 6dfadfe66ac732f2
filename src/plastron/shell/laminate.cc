#include <plastron/shell/laminate.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
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
    s.initial_force += height * initial;
    s.initial_moment += height * middle * initial;
  }
  return s;
}

std::array<Vector3d, 3> stress_per_kelvin(const std::vector<Layer>& layers, const std::vector<double>& z) {
  std::array<Vector3d, 3> all{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Orthotropic& material = layers[k].material;
    const Vector3d stress =
        strain_map(turned(layers[k].angle)).transpose() * (material.in_plane() * material.expansion());
    const double height = z[k + 1] - z[k], middle = (z[k] + z[k + 1]) / 2;
    all[0] += height * stress;
    all[1] += height * middle * stress;
    all[2] += height * (middle * middle + height * height / 12) * stress;
  }
  return all;
}

/// Returns int C (alpha b) z^k dz, k = 1, 2, over the thickness 1, `curvature` b in the laminate's axes.
std::array<Vector3d, 2> stress_by_curvature(const std::vector<Layer>& layers, const std::vector<double>& z,
                                            const Vector3d& curvature) {
  std::array<Vector3d, 2> both{Vector3d::Zero(), Vector3d::Zero()};
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Matrix3d map = strain_map(turned(layers[k].angle));
    const Orthotropic& material = layers[k].material;
    const Vector3d stress = map.transpose() * (material.in_plane() * material.bent_expansion(map * curvature));
    const double height = z[k + 1] - z[k], middle = (z[k] + z[k + 1]) / 2;
    both[0] += height * middle * stress;
    both[1] += height * (middle * middle + height * height / 12) * stress;
  }
  return both;
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

/// Returns the turn from the laminate's axes to the axes of bending: the direction of the largest bending stiffness, by its part of
/// period pi, or pi/2 where the first vanishes. They do not depend on the axes in which the layers are described.
double angle_of_bending(const Matrix3d& d) {
  constexpr double rounding = 1e-9;
  const double least = rounding * (d(0, 0) + d(1, 1));
  const double a2 = (d(0, 0) - d(1, 1)) / 2, b2 = d(0, 2) + d(1, 2);
  if (std::hypot(a2, b2) > least) return std::atan2(b2, a2) / 2;
  const double a4 = (d(0, 0) + d(1, 1) - 2 * d(0, 1) - 4 * d(2, 2)) / 8, b4 = (d(0, 2) - d(1, 2)) / 2;
  return std::hypot(a4, b4) > least ? std::atan2(b4, a4) / 4 : 0;
}

/// Returns A, B, D of strains in other axes.
Eigen::Matrix<double, 6, 6> in_other_axes(const Eigen::Matrix<double, 6, 6>& in_plane, const Matrix2d& axes) {
  // The inverse of the map of strains: axes are orthonormal.
  const Matrix3d back = strain_map(axes.transpose());
  Eigen::Matrix<double, 6, 6> both = Eigen::Matrix<double, 6, 6>::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = back;
  return both.transpose() * in_plane * both;
}

}  // namespace

TransverseShear::TransverseShear(const std::vector<Layer>& layers, const std::vector<double>& interfaces,
                                 const Eigen::Matrix<double, 6, 6>& in_plane)
    : interfaces_(interfaces),
      axes_(turned(angle_of_bending(in_plane.bottomRightCorner<3, 3>()))),
      compliance_(in_other_axes(in_plane, axes_).llt().solve(Eigen::Matrix<double, 6, 6>::Identity())) {
  Matrix2d below = Matrix2d::Zero();
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Matrix2d own = turned(layers[k].angle) * axes_.transpose();
    const Matrix3d map = strain_map(own);
    const Eigen::Vector2d moduli(layers[k].material.G13, layers[k].material.G23);
    plies_.push_back({.stiffness = map.transpose() * layers[k].material.in_plane() * map,
                      .moduli = own.transpose() * moduli.asDiagonal() * own,
                      .at_interface = below});
    below += gain(plies_.back(), interfaces_[k], interfaces_[k + 1]);
  }
}

Matrix2d TransverseShear::gain(const Ply& ply, double from, double to) const {
  Matrix2d gain;
  for (int a = 0; a < 2; ++a) {
    const Vector3d gamma = compliance_.col(3 + a).head<3>(), chi = compliance_.col(3 + a).tail<3>();
    const Vector3d stress = ply.stiffness * ((to - from) * gamma + (to * to - from * from) / 2 * chi);
    gain(a, a) = -stress[a];
    gain(1 - a, a) = -stress[2];
  }
  return gain;
}

Matrix2d TransverseShear::stress(std::size_t layer, double z) const {
  return axes_.transpose() * stress_in_bending_axes(layer, z) * axes_;
}

Matrix2d TransverseShear::stiffness() const {
  const double away = std::sqrt(0.6) / 2;
  // Parts of the height and weights of Gauss points: the integrand has degree 4.
  const std::array<std::pair<double, double>, 3> points{
      {{0.5 - away, 5.0 / 18}, {0.5, 4.0 / 9}, {0.5 + away, 5.0 / 18}}};
  Matrix2d compliance = Matrix2d::Zero();
  for (std::size_t k = 0; k < plies_.size(); ++k)
    for (const auto& [part, weight] : points) {
      const double height = interfaces_[k + 1] - interfaces_[k];
      const Matrix2d stress = stress_in_bending_axes(k, interfaces_[k] + part * height);
      compliance += weight * height * (stress.transpose() * plies_[k].moduli.llt().solve(stress));
    }
  return axes_.transpose() * compliance.inverse() * axes_;
}

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
      unit_(unit_section(layers_, interfaces_)),
      stress_per_kelvin_(stress_per_kelvin(layers_, interfaces_)),
      transverse_shear_(layers_, interfaces_, unit_.in_plane()) {
  constexpr double homogeneous = 5.0 / 6;  // energy of the parabola against that of its mean
  unit_.shear = transverse_shear_.stiffness() / homogeneous;
}

bool Laminate::expands() const {
  return std::ranges::any_of(layers_, [](const Layer& layer) { return !layer.material.expansion().isZero(0); });
}

double Laminate::young() const {
  return mean_over(layers_, [](const Orthotropic& m) { return (m.E1 + m.E2) / 2; });
}

double Laminate::shear_modulus() const {
  return mean_over(layers_, [](const Orthotropic& m) { return (m.G13 + m.G23) / 2; });
}

// Faces are the parts between soft layers. With D_f the sum of their bending stiffnesses about their own middles and S the
// shear stiffness, the deflection that neither bends the faces nor shears the core decays over sqrt(D_f / S).
double Laminate::face_length() const {
  constexpr double soft = 0.1;  // part of the largest shear modulus
  const auto modulus = [&](std::size_t k) { return std::min(layers_[k].material.G13, layers_[k].material.G23); };
  double largest = 0;
  for (std::size_t k = 0; k < layers_.size(); ++k) largest = std::max(largest, modulus(k));
  double bending = 0;
  bool has_soft_layer = false;
  for (std::size_t k = 0; k < layers_.size();) {
    if (modulus(k) < soft * largest) {
      has_soft_layer = true;
      ++k;
      continue;
    }
    double stiffness = 0, moment = 0, second = 0;
    for (; k < layers_.size() && modulus(k) >= soft * largest; ++k) {
      const double height = interfaces_[k + 1] - interfaces_[k], middle = (interfaces_[k + 1] + interfaces_[k]) / 2;
      const double along = height * std::max(layers_[k].material.E1, layers_[k].material.E2);
      stiffness += along;
      moment += along * middle;
      second += along * (middle * middle + height * height / 12);
    }
    bending += second - moment * moment / stiffness;
  }
  const Eigen::Vector2d shear = Eigen::SelfAdjointEigenSolver<Matrix2d>(transverse_shear_.stiffness()).eigenvalues();
  return has_soft_layer ? std::sqrt(bending / shear[0]) : 0;
}

bool Laminate::has_axes(const Vector3d& a3) const {
  constexpr double least_sine = 0.01;
  return geometry::tangential(direction_, a3).norm() >= least_sine;
}

Matrix2d Laminate::axes(const geometry::Frame& frame) const {
  // A director need not be normal to the tangents; the layers lie along these.
  const Vector3d normal = frame.a_cov[0].cross(frame.a_cov[1]) / frame.sqrt_a;
  const Vector3d t1 = geometry::tangential(direction_, normal).normalized(), t2 = normal.cross(t1);
  Matrix2d axes;
  axes << t1.dot(frame.a_con[0]), t1.dot(frame.a_con[1]), t2.dot(frame.a_con[0]), t2.dot(frame.a_con[1]);
  return axes;
}

Section Laminate::section(const Matrix2d& axes, double thickness, double shear_correction,
                          const InitialState& initial) const {
  const double e = thickness, mean = initial.temperature, difference = initial.difference;
  const Matrix3d map = strain_map(axes);
  const auto& heat = stress_per_kelvin_;
  Vector3d force = initial.strains * unit_.initial_force + mean * heat[0] + difference * heat[1],
           moment = initial.strains * unit_.initial_moment + mean * heat[1] + difference * heat[2];
  if (mean != 0 && !initial.curvature.isZero(0)) {
    const std::array<Vector3d, 2> bent = stress_by_curvature(layers_, interfaces_, mean * map * initial.curvature);
    force -= e * bent[0];
    moment -= e * bent[1];
  }
  return {.membrane = e * (map.transpose() * unit_.membrane * map),
          .bending = e * e * e * (map.transpose() * unit_.bending * map),
          .shear = shear_correction * e * (axes.transpose() * unit_.shear * axes),
          .coupling = e * e * (map.transpose() * unit_.coupling * map),
          .initial_force = e * (map.transpose() * force),
          .initial_moment = e * e * (map.transpose() * moment)};
}

LaminateSection::LaminateSection(std::shared_ptr<const Laminate> laminate, const geometry::Frame& axes,
                                 double thickness, double shear_correction, const InitialState& initial)
    : laminate_(std::move(laminate)),
      thickness_(thickness),
      axes_(laminate_->axes(axes)),
      section_(laminate_->section(axes_, thickness, shear_correction, initial)),
      compliance_(section_.in_plane().llt().solve(Eigen::Matrix<double, 6, 6>::Identity())) {
  for (const Layer& layer : laminate_->layers()) {
    const Matrix2d own = turned(layer.angle) * axes_;
    const Matrix3d map = strain_map(own), c = layer.material.in_plane();
    plies_.push_back(
        {.stiffness = map.transpose() * c * map,
         .initial_stress = map.transpose() *
                           (c * (initial.strains * layer.strain + initial.temperature * layer.material.expansion())),
         .initial_slope =
             map.transpose() * (c * (initial.difference / thickness * layer.material.expansion() -
                                     initial.temperature * layer.material.bent_expansion(map * initial.curvature))),
         .axes = own});
  }
}

std::size_t LaminateSection::layer_at(double z) const {
  // Above the mid-surface an interface belongs to the layer below it, elsewhere to the layer above.
  std::size_t k = 0;
  while (k + 1 < layer_count() && (z > interface(k + 1) || (z == interface(k + 1) && z <= 0))) ++k;
  return k;
}

StressMap LaminateSection::stress(std::size_t layer, double z) const {
  const Ply& ply = plies_[layer];
  StressMap s;
  s.map.topLeftCorner<3, 6>() = ply.stiffness * (compliance_.topRows<3>() + z * compliance_.bottomRows<3>());
  s.map.bottomRightCorner<2, 2>() =
      axes_.transpose() * laminate_->transverse_shear().stress(layer, z / thickness_) * axes_ / thickness_;
  s.constant.head<3>() = s.map.topLeftCorner<3, 6>() * section_.initial_resultants().head<6>() - ply.initial_stress -
                         z * ply.initial_slope;
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
