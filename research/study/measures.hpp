// Measures of solutions that several studies take: sizes of the shell, distances in the energy norm, their noise, and exponents of power laws.
#pragma once
#include <plastron/computation/result.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace plastron::study {

/// Stands for a value that is not defined or says nothing.
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

// ---- the shell ---------------------------------------------------------------------------------------------------------

/// By the nodal quadrature.
struct ShellSize {
  double area = 0;       ///< of the mid-surface [m^2]
  double thickness = 0;  ///< mean e [m]
  double mesh_size = 0;  ///< h: side of a square as large as the mean cell [m]
};

/// (collective)
ShellSize shell_size(const assembly::DiscreteShell& discrete);

// ---- distances ---------------------------------------------------------------------------------------------------------

/// The relative error of the solver's solution in the energy norm: its tolerance is a thousandth of it.
constexpr double solver_noise = 1e-9;

/// With a relative noise beyond it a solution says nothing.
constexpr double too_noisy = 1e-2;

/// The energy norm of rounding errors of the nodal values: strains of eps |u| / h and the like. Where supports prescribe
/// motions the solver leaves more than rounding [J^{1/2}]. (collective)
double rounding_norm(const computation::Solution& solution);

/// The part of |U|_a = `energy_norm` that is noise: the solver's, or more where rounding leaves less of U's digits (a shell
/// that moves as a rigid body); infinite for U = 0. (collective)
double relative_noise(const computation::Solution& solution, double energy_norm);

/// a - b.
algebra::Vector difference(algebra::Vector a, const algebra::Vector& b);

/// |y - reference|_a / |reference|_a; NaN where the reference has no energy. (collective)
double relative_distance(const energy::ShellOperator& shell, const algebra::Vector& y,
                         const algebra::Vector& reference);

/// value / reference - 1; zero if both are zero.
double relative_difference(double value, double reference);

/// |W|_a = a(W, W)^{1/2} of the W in V with n . (w + z s) = change at the owned nodes marked in `at` that has the least
/// energy [J^{1/2}]: the capacity of these nodes. Other nodes and components are free, supports hold at zero. Zero if no
/// node is marked on any rank, empty if the system is singular. (collective)
std::optional<double> lifting_norm(const assembly::DiscreteShell& discrete, std::span<const char> at, double change);

// ---- exponents ---------------------------------------------------------------------------------------------------------

/// take(sample) of all samples; `take` may be a pointer to a member.
template <class Sample, class Take>
std::vector<double> column(const std::vector<Sample>& samples, const Take& take) {
  std::vector<double> values;
  values.reserve(samples.size());
  for (const Sample& sample : samples) values.push_back(std::invoke(take, sample));
  return values;
}

/// Exponents p of y ~ x^p between neighbours: log(y_i / y_{i-1}) / log(x_i / x_{i-1}); NaN for the first and where a value is
/// not positive.
std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y);

/// Least squares of log y over log x on the last `last` pairs; NaN for fewer than two usable x.
double fitted_exponent(std::span<const double> x, std::span<const double> y, std::size_t last = 3);

/// The last i for which values[i - 1] and values[i] both exceed `noise`, and so have an exponent; 0 if there is none. NaN
/// stands for a value that says nothing.
std::size_t last_step_above(std::span<const double> values, double noise);

}  // namespace plastron::study
