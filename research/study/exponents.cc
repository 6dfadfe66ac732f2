#include <research/study/exponents.hpp>

#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

bool usable(double x, double y) { return x > 0 && y > 0 && std::isfinite(x) && std::isfinite(y); }

}  // namespace

std::vector<double> local_exponents(std::span<const double> x, std::span<const double> y) {
  std::vector<double> exponents(x.size(), no_value);
  for (std::size_t i = 1; i < x.size(); ++i)
    if (usable(x[i - 1], y[i - 1]) && usable(x[i], y[i]))
      exponents[i] = std::log(y[i] / y[i - 1]) / std::log(x[i] / x[i - 1]);
  return exponents;
}

double fitted_exponent(std::span<const double> x, std::span<const double> y, std::size_t last) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = x.size() > last ? x.size() - last : 0; i < x.size(); ++i) {
    if (!usable(x[i], y[i])) continue;
    const double a = std::log(x[i]), b = std::log(y[i]);
    n += 1;
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  const double spread = n * sxx - sx * sx;
  return n < 2 || !(spread > 1e-12 * n * sxx) ? no_value : (n * sxy - sx * sy) / spread;
}

std::size_t last_step_above(std::span<const double> values, double noise) {
  for (std::size_t i = values.size(); i-- > 1;)
    if (values[i - 1] > noise && values[i] > noise) return i;
  return 0;
}

}  // namespace plastron::study
