#include "parser.hpp"

#include <plastron/geometry/quotation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plastron::geometry {

namespace {

double square(double a) { return a * a; }
double cube(double a) { return a * a * a; }
double natural_log(double a) { return std::log(a); }
double arc_tangent2(double a, double b) { return std::atan2(a, b); }
double sign_of(double a) { return (a > 0) - (a < 0); }
double unit_step(double a) { return a > 0 ? 1 : (a < 0 ? 0 : 0.5); }

}  // namespace

mu::Parser parser_with(const Constants& constants) {
  mu::Parser parser;
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
  for (const auto& [name, value] : constants) parser.DefineConst(name, value);
  parser.DefineFun("log", natural_log);
  parser.DefineFun("atan2", arc_tangent2);
  parser.DefineFun("sq", square);
  parser.DefineFun("cube", cube);
  parser.DefineFun("sign", sign_of);
  parser.DefineFun("step", unit_step);
  return parser;
}

void check_size(const std::string& text) {
  if (text.size() > longest_expression)
    throw ExpressionError(fmt::format("\"{}\" is {} characters long, at most {} are allowed", shortened(text),
                                      text.size(), longest_expression),
                          longest_expression);
  std::size_t depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(' && ++depth > deepest_brackets)
      throw ExpressionError(
          fmt::format("\"{}\" has more than {} brackets in each other", shortened(text), deepest_brackets), i);
    if (text[i] == ')' && depth > 0) --depth;
  }
}

[[noreturn]] void rethrow(const mu::ParserError& error, const std::string& text) {
  const auto position = error.GetPos() < 0 ? std::size_t{0} : static_cast<std::size_t>(error.GetPos());
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      throw ExpressionError(fmt::format("unknown name \"{}\" in \"{}\"", shortened(error.GetToken()), shortened(text)),
                            position);
    case mu::ecUNEXPECTED_EOF:
      throw ExpressionError(fmt::format("\"{}\" ends too early", shortened(text)), text.size());
    default:
      throw ExpressionError(fmt::format("\"{}\": {}", shortened(text), shortened(error.GetMsg(), 200)),
                            std::min(position, text.size()));
  }
}

}  // namespace plastron::geometry
