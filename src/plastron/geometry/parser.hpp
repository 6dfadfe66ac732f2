// muParser with the constants and functions of expressions, and its errors in Plastron's words.
#pragma once
#include <plastron/geometry/expression_text.hpp>

#include <muParser.h>

#include <string>

namespace plastron::geometry {

mu::Parser parser_with(const Constants& constants);

/// Throws ExpressionError for a text that is too long or has too deeply nested brackets.
void check_size(const std::string& text);

/// Throws the error as ExpressionError.
[[noreturn]] void rethrow(const mu::ParserError& error, const std::string& text);

}  // namespace plastron::geometry
