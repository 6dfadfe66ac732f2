// Exponents p of power laws y ~ x^p, from measured pairs.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace plastron::study {

/// Between neighbours: log(y_i / y_{i-1}) / log(x_i / x_{i-1}); NaN for the first and where a value is not positive.
std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y);

/// Least squares of log y over log x on the last `last` pairs; NaN for fewer than two usable x.
double fitted_exponent(std::span<const double> x, std::span<const double> y, std::size_t last = 3);

/// The last i for which values[i - 1] and values[i] both exceed `noise`, and so have an exponent; 0 if there is none. NaN
/// stands for a value that says nothing.
std::size_t last_step_above(std::span<const double> values, double noise);

}  // namespace plastron::study
