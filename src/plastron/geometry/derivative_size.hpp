// How long the derivatives of a formula become, before they are made: a product of n factors has n^2 terms in its second
// derivative, each as long as the product, and nested functions multiply likewise.
#pragma once
#include <ginac/ginac.h>

namespace plastron::geometry {

/// Nodes of the formula and of its derivatives with respect to one variable, estimated from above.
struct DerivativeSize {
  double value = 1, first = 0, second = 0;
};

DerivativeSize derivative_size(const GiNaC::ex& formula);

}  // namespace plastron::geometry
