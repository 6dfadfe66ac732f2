// Detection of expressions that may consist of pieces with jumps or kinks.
#pragma once
#include <plastron/geometry/expression.hpp>

namespace plastron::geometry {

/// Whether the text has a comparison, a choice or one of abs, atan2, max, min, rint, sign, step. Without these it is
/// smooth wherever it is finite.
bool is_piecewise(const Expression& f);

}  // namespace plastron::geometry
