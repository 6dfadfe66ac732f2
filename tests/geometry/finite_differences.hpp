// Derivatives by central differences of order eight: an independent check of derivatives that should be exact.
// With the step 0.02 and functions that vary over a length of about one, the error is near 1e-12 for first derivatives
// and 1e-10 for second ones.
#pragma once
#include <plastron/geometry/jet.hpp>

#include <functional>

#include "larger.hpp"

namespace plastron::geometry {

inline constexpr double difference_step = 0.02;

/// f'(t); `f` maps a number to anything with + and multiplication by a number.
template <class Function>
auto derivative(const Function& f, double t) {
  constexpr double h = difference_step;
  constexpr double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  using Value = std::decay_t<decltype(f(t))>;
  Value sum = f(t) * 0.0;
  for (int k = 1; k <= 4; ++k) sum += (f(t + k * h) - f(t - k * h)) * (weight[k - 1] / h);
  return sum;
}

/// The jet of a map of the plane, from its values alone.
template <class Point, class Map>
Jet<Point> jet_by_differences(const Map& f, const Vector2d& x) {
  const auto value = [&](double s, double t) -> Point { return f(s, t); };
  const auto d1 = [&](double s, double t) -> Point { return derivative([&](double p) { return value(p, t); }, s); };
  const auto d2 = [&](double s, double t) -> Point { return derivative([&](double q) { return value(s, q); }, t); };
  Jet<Point> jet;
  jet.value = value(x[0], x[1]);
  jet.d = {d1(x[0], x[1]), d2(x[0], x[1])};
  jet.dd = {derivative([&](double s) { return d1(s, x[1]); }, x[0]),
            derivative([&](double t) { return d1(x[0], t); }, x[1]),
            derivative([&](double t) { return d2(x[0], t); }, x[1])};
  return jet;
}

/// The largest difference of two jets, second derivatives included. NaN if any difference is NaN.
template <class Point>
double distance(const Jet<Point>& a, const Jet<Point>& b) {
  double most = (a.value - b.value).norm();
  for (std::size_t k = 0; k < 2; ++k) most = test::larger(most, (a.d[k] - b.d[k]).norm());
  for (std::size_t k = 0; k < 3; ++k) most = test::larger(most, (a.dd[k] - b.dd[k]).norm());
  return most;
}

}  // namespace plastron::geometry
