// Truncated Taylor series in two variables: the arithmetic that differentiates manufactured solutions exactly.
// A Series has the coefficients of dx^i dy^j, i + j <= 3. Every derivative() makes the highest order worthless;
// after k of them the rest is exact up to order 3 - k.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

namespace plastron::verification {

class Series {
 public:
  static constexpr int order = 3;

  Series(double constant = 0) { c_[0] = constant; }  // NOLINT: numbers are series
  /// The coordinate `axis` (0 or 1) about the point where it has the given value.
  static Series variable(int axis, double value) {
    Series s(value);
    s.c_[1 + axis] = 1;
    return s;
  }

  double value() const { return c_[0]; }
  /// First partial derivative at the point.
  double d(int axis) const { return c_[1 + axis]; }

  Series derivative(int axis) const {
    Series s;
    for (int n = 1; n <= order; ++n)
      for (int j = 0; j <= n; ++j) {
        const int i = n - j, power = axis == 0 ? i : j;
        if (power > 0) s.c_[index(i - (axis == 0), j - (axis == 1))] = power * c_[index(i, j)];
      }
    return s;
  }

  Series& operator+=(const Series& o) {
    for (int k = 0; k < size; ++k) c_[k] += o.c_[k];
    return *this;
  }
  Series& operator-=(const Series& o) {
    for (int k = 0; k < size; ++k) c_[k] -= o.c_[k];
    return *this;
  }
  friend Series operator+(Series a, const Series& b) { return a += b; }
  friend Series operator-(Series a, const Series& b) { return a -= b; }
  friend Series operator-(const Series& a) { return Series() - a; }
  friend Series operator*(const Series& a, const Series& b) {
    Series s;
    for (const auto& [i, j, k] : products) s.c_[k] += a.c_[i] * b.c_[j];
    return s;
  }
  /// 1 / a = (1 - h + h^2 - h^3) / a_0 with h = a / a_0 - 1.
  friend Series inverse(const Series& a) {
    const Series h = a * Series(1 / a.value()) - Series(1);
    return Series(1 / a.value()) * (Series(1) - h * (Series(1) - h * (Series(1) - h)));
  }
  friend Series operator/(const Series& a, const Series& b) { return a * inverse(b); }
  /// sqrt(1 + h) = 1 + h/2 - h^2/8 + h^3/16.
  friend Series sqrt(const Series& a) {
    const Series h = a * Series(1 / a.value()) - Series(1);
    return Series(std::sqrt(a.value())) * (Series(1) + h * (Series(0.5) + h * (Series(-0.125) + h * Series(0.0625))));
  }
  /// max(0, a): differentiable only where a is not zero.
  friend Series positive_part(const Series& a) { return a.value() > 0 ? a : Series(); }

 private:
  static constexpr int size = (order + 1) * (order + 2) / 2;
  static constexpr int index(int i, int j) { return (i + j) * (i + j + 1) / 2 + j; }

  /// Coefficient i of one factor times coefficient j of the other goes to coefficient k of the product.
  struct Product {
    int i, j, k;
  };
  static constexpr auto make_products() {
    std::array<Product, 35> all{};
    int count = 0;
    for (int n = 0; n <= order; ++n)
      for (int m = 0; n + m <= order; ++m)
        for (int p = 0; p <= n; ++p)
          for (int q = 0; q <= m; ++q) all[count++] = {index(n - p, p), index(m - q, q), index(n + m - p - q, p + q)};
    return all;
  }
  static const std::array<Product, 35> products;

  std::array<double, size> c_{};
};

inline constexpr std::array<Series::Product, 35> Series::products = Series::make_products();

/// A vector of R^3 whose components are series.
struct SeriesVector {
  std::array<Series, 3> c;

  const Series& operator[](int i) const { return c[i]; }
  Series& operator[](int i) { return c[i]; }
  SeriesVector derivative(int axis) const {
    return {{c[0].derivative(axis), c[1].derivative(axis), c[2].derivative(axis)}};
  }
  Eigen::Vector3d value() const { return {c[0].value(), c[1].value(), c[2].value()}; }
  Eigen::Vector3d d(int axis) const { return {c[0].d(axis), c[1].d(axis), c[2].d(axis)}; }

  friend SeriesVector operator+(const SeriesVector& a, const SeriesVector& b) {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
  }
  friend SeriesVector operator*(const Series& s, const SeriesVector& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
  friend Series dot(const SeriesVector& a, const SeriesVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  friend SeriesVector cross(const SeriesVector& a, const SeriesVector& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
};

}  // namespace plastron::verification
