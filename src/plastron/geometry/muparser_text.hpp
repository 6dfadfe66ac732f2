// Conversion of GiNaC's derivatives to text, which muParser evaluates fast.
#pragma once
#include <ginac/ginac.h>

#include <string>

namespace plastron::geometry {

/// Returns the text. Throws std::invalid_argument for formulas without one: complex numbers, unevaluated derivatives.
std::string in_muparser_syntax(const GiNaC::ex& e);

/// Throws std::invalid_argument if the second derivatives would be too long.
void check_derivative_size(const GiNaC::ex& f);

}  // namespace plastron::geometry
