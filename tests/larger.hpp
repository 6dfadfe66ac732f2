// The larger of two numbers for measures of error: unlike std::max it keeps a NaN, so that what is no number fails a test.
#pragma once
#include <cmath>

namespace plastron::test {

inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

}  // namespace plastron::test
