// From the text of an expression to a formula GiNaC can differentiate.
#pragma once
#include <ginac/ginac.h>

#include <map>
#include <string>

namespace plastron::geometry {

/// The formula with the precedences of muParser, which evaluates expressions: -x^2 = -(x^2), 2^-1*x = (2^-1)*x, x^y^z =
/// x^(y^z). GiNaC's own parser reads the last two otherwise. `names` are the symbols that may occur. Precondition:
/// muParser accepts the text. Throws std::invalid_argument for what has no two derivatives (comparisons, choices, min,
/// max, sign).
GiNaC::ex formula(const std::string& text, const std::map<std::string, GiNaC::ex>& names);

}  // namespace plastron::geometry
