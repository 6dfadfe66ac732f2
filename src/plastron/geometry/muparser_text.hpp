// From GiNaC's derivatives back to text, which muParser evaluates fast.
#pragma once
#include <ginac/ginac.h>

#include <string>

namespace plastron::geometry {

/// Throws std::invalid_argument for what has no such text: complex numbers, unevaluated derivatives.
std::string in_muparser_syntax(const GiNaC::ex& e);

/// Throws std::invalid_argument if the second derivatives would be too long to make.
void check_derivative_size(const GiNaC::ex& f);

}  // namespace plastron::geometry
