// Exponents p of power laws y ~ x^p, from measured pairs.
#pragma once
#include <span>
#include <vector>

namespace plastron::study {

/// Between neighbours: log(y_i / y_{i-1}) / log(x_i / x_{i-1}); NaN for the first and where a value is not positive.
std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y);

/// Least squares of log y over log x on the last `last` pairs; NaN for fewer than two usable pairs.
double fitted_exponent(std::span<const double> x, std::span<const double> y, std::size_t last = 3);

}  // namespace plastron::study
