// Smooth random functions on Omega, the same for the same seed on every machine and every rank.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

namespace plastron::study {

/// Uniform numbers from a seed; the standard library's distributions differ between its makers.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  /// In [-1, 1].
  double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-52 - 1; }

 private:
  std::mt19937_64 bits_;
};

/// A sum of a few waves with random amplitudes, directions and phases in each of three components, of size about one.
/// Wave lengths go down to about `length`.
inline std::function<Eigen::Vector3d(double, double)> random_field(Random& random, double length) {
  struct Wave {
    Eigen::Vector3d amplitude;
    double kx, ky, phase;
  };
  constexpr double pi = 3.14159265358979323846;
  std::array<Wave, 6> waves;
  for (Wave& w : waves) {
    for (int k = 0; k < 3; ++k) w.amplitude[k] = random() / 2;
    w.kx = 2 * pi / length * random();
    w.ky = 2 * pi / length * random();
    w.phase = pi * random();
  }
  return [waves](double x, double y) -> Eigen::Vector3d {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    for (const Wave& w : waves) value += w.amplitude * std::cos(w.kx * x + w.ky * y + w.phase);
    return value;
  };
}

}  // namespace plastron::study
