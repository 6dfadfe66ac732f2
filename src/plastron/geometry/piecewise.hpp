// Whether an expression may be made of pieces: jumps, kinks.
#pragma once
#include <plastron/geometry/expression.hpp>

namespace plastron::geometry {

/// The text has a comparison, a choice or one of abs, atan2, max, min, rint, sign, step. What has none of them is smooth
/// wherever it is finite.
bool is_piecewise(const Expression& f);

}  // namespace plastron::geometry
