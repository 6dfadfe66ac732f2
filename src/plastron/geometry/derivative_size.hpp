// Estimates the length of a formula's derivatives before they are made. A product of n factors has n^2 terms in its
// second derivative, each as long as the product; nested functions multiply in a similar way.
#pragma once
#include <ginac/ginac.h>

namespace plastron::geometry {

/// Upper estimates of the number of nodes of a formula and of its derivatives with respect to one variable.
struct DerivativeSize {
  double value = 1, first = 0, second = 0;
};

DerivativeSize derivative_size(const GiNaC::ex& formula);

}  // namespace plastron::geometry
