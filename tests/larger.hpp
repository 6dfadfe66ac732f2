// The larger of two measures of error. Unlike std::max it keeps a NaN, so that a NaN fails a test.
#pragma once
#include <cmath>

namespace plastron::test {

inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

}  // namespace plastron::test
