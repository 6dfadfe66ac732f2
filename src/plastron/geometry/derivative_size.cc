#include "derivative_size.hpp"

namespace plastron::geometry {

namespace {

/// f(g): f' g', then f'' g' g' + f' g''. The derivatives of f contain f and g a few times.
DerivativeSize composed(const DerivativeSize& g) {
  constexpr double of_function = 4;
  const double f = of_function * (1 + g.value);
  return {1 + g.value, g.first > 0 ? f + g.first : 0, g.first > 0 ? 2 * f + 2 * g.first + g.second : 0};
}

DerivativeSize sum_of(const DerivativeSize& a, const DerivativeSize& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

/// Leibniz's rule for all factors at once.
DerivativeSize product(const GiNaC::ex& e) {
  DerivativeSize all{.value = 1};
  double varying = 0;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const DerivativeSize factor = derivative_size(e.op(i));
    all = sum_of(all, factor);
    if (factor.first > 0) varying += 1;
  }
  return {all.value, all.first + varying * all.value,
          all.second + 2 * varying * all.first + varying * varying * all.value};
}

}  // namespace

DerivativeSize derivative_size(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return {1, 1, 0};
  if (GiNaC::is_a<GiNaC::mul>(e)) return product(e);
  DerivativeSize all{.value = 1};
  for (std::size_t i = 0; i < e.nops(); ++i) all = sum_of(all, derivative_size(e.op(i)));
  return GiNaC::is_a<GiNaC::add>(e) || e.nops() == 0 ? all : composed(all);
}

}  // namespace plastron::geometry
