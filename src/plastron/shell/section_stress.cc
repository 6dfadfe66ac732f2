#include <plastron/shell/section_stress.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::shell {

Stress stress_of(const StressMap& s, const SectionForces& f) {
  const Eigen::Matrix<double, 5, 1> all = s.map * f.all() + s.constant;
  return {all.head<3>(), all.tail<2>()};
}

StressMap stress_map(const SectionForces& f, double z) {
  if (f.laminate) return f.laminate->stress(f.laminate->layer_at(z), z);
  const double e = f.thickness, side = 2 * z / e;
  StressMap s;
  s.map.topLeftCorner<3, 3>().diagonal().setConstant(1 / e);
  s.map.block<3, 3>(0, 3).diagonal().setConstant(12 * z / (e * e * e));
  s.map.bottomRightCorner<2, 2>().diagonal().setConstant(1.5 * (1 - side * side) / e);
  return s;
}

Stress stress_at(const SectionForces& f, double z) { return stress_of(stress_map(f, z), f); }

Vector3d in_plane_stress(const SectionForces& f, double z) { return stress_at(f, z).in_plane; }

Eigen::Vector2d shear_stress(const SectionForces& f, double z) { return stress_at(f, z).shear; }

Eigen::Vector2d mean_shear_stress(const SectionForces& f) { return f.Q / f.thickness; }

double von_mises(const Vector3d& s, const Eigen::Vector2d& shear) {
  return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * (s[2] * s[2] + shear.squaredNorm()));
}

double von_mises(const Stress& s) { return von_mises(s.in_plane, s.shear); }

double von_mises_at(const SectionForces& f, double z) { return von_mises(stress_at(f, z)); }

Vector8 von_mises_derivative(const SectionForces& f, double z) {
  const StressMap map = stress_map(f, z);
  const Stress at = stress_of(map, f);
  const Vector3d& s = at.in_plane;
  const double stress = von_mises(at);
  if (!(stress > 0)) return Vector8::Zero();
  Eigen::Matrix<double, 5, 1> by_stress;
  by_stress << Vector3d(2 * s[0] - s[1], 2 * s[1] - s[0], 6 * s[2]) / (2 * stress), 3 / stress * at.shear;
  return map.map.transpose() * by_stress;
}

namespace {

/// The largest von_mises_at over the layers of a laminate. In each layer its square is a polynomial of degree 4 in z;
/// the neighbourhood of the largest of several samples is searched by thirds.
LargestVonMises largest_in_laminate(const SectionForces& f) {
  constexpr int samples = 8, thirds = 30;
  LargestVonMises largest;
  for (std::size_t k = 0; k < f.laminate->layer_count(); ++k) {
    const double bottom = f.laminate->interface(k), step = (f.laminate->interface(k + 1) - bottom) / samples;
    const auto stress = [&](double z) { return von_mises(stress_of(f.laminate->stress(k, z), f)); };
    int best = 0;
    for (int i = 1; i <= samples; ++i)
      if (stress(bottom + i * step) > stress(bottom + best * step)) best = i;
    double low = bottom + std::max(best - 1, 0) * step, high = bottom + std::min(best + 1, samples) * step;
    for (int i = 0; i < thirds; ++i) {
      const double first = low + (high - low) / 3, second = high - (high - low) / 3;
      if (stress(first) < stress(second))
        low = first;
      else
        high = second;
    }
    for (const double z : {bottom + best * step, (low + high) / 2})
      if (stress(z) > largest.stress) largest = {stress(z), z};
  }
  return largest;
}

}  // namespace

LargestVonMises largest_von_mises(const SectionForces& f) {
  if (f.laminate) return largest_in_laminate(f);
  LargestVonMises largest;
  const auto look_at = [&](double s) {
    const double z = s * f.thickness / 2, stress = von_mises_at(f, z);
    if (stress > largest.stress) largest = {stress, z};
  };
  look_at(0);
  look_at(-1);
  look_at(1);
  const Vector3d constant = f.N / f.thickness, slope = 6 / (f.thickness * f.thickness) * f.M;
  const auto product = [](const Vector3d& a, const Vector3d& b) {
    return a[0] * b[0] - (a[0] * b[1] + a[1] * b[0]) / 2 + a[1] * b[1] + 3 * a[2] * b[2];
  };
  const double D = 6.75 * f.Q.squaredNorm() / (f.thickness * f.thickness);
  const double inner = 2 * D - product(slope, slope);
  if (inner <= 0) return largest;  // convex
  // The middle one of the three roots of s^3 - 3 a^2 s + q, where the derivative vanishes, is the only inner maximum.
  const double a = std::sqrt(inner / (6 * D)), q = product(constant, slope) / (2 * D);
  const double sine = q / (2 * a * a * a);
  if (std::abs(sine) < 1) look_at(2 * a * std::sin(std::asin(sine) / 3));
  return largest;
}

Principal principal(const Vector3d& t) {
  const double mean = (t[0] + t[1]) / 2, half = (t[0] - t[1]) / 2, radius = std::hypot(half, t[2]);
  return {mean + radius, mean - radius, std::atan2(t[2], half) / 2};
}

EnergyDensity energy_density(const Material& material, const SectionForces& f) {
  const Section section =
      f.laminate ? f.laminate->section()
                 : section_at(material, orthonormal_frame(Vector3d::UnitX(), Vector3d::UnitY()), f.thickness);
  const Vector8 n = f.all(), strains = section.strains_of(n);
  return {n.head<3>().dot(strains.head<3>()) / 2, n.segment<3>(3).dot(strains.segment<3>(3)) / 2,
          n.tail<2>().dot(strains.tail<2>()) / 2};
}

}  // namespace plastron::shell
