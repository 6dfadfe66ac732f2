// Symbolic derivatives: conversion of an expression's text to a formula of GiNaC, and of its derivatives to text that
// muParser evaluates fast.
#pragma once
#include <ginac/ginac.h>

#include <map>
#include <string>

namespace plastron::geometry {

/// Returns the formula with the precedences of muParser, which evaluates expressions: -x^2 = -(x^2), 2^-1*x =
/// (2^-1)*x, x^y^z = x^(y^z). GiNaC's own parser interprets the last two differently. `names` are the symbols that
/// may occur. Precondition: muParser accepts the text. Throws std::invalid_argument for functions without two
/// derivatives (comparisons, choices, min, max, sign).
GiNaC::ex formula(const std::string& text, const std::map<std::string, GiNaC::ex>& names);

/// Throws std::invalid_argument if the second derivatives would be too long, before they are made.
void check_derivative_size(const GiNaC::ex& f);

/// Returns the text. Throws std::invalid_argument for formulas without one: complex numbers, unevaluated derivatives.
std::string in_muparser_syntax(const GiNaC::ex& e);

}  // namespace plastron::geometry
