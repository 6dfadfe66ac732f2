#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/quotation.hpp>

#include <fmt/format.h>
#include <muParser.h>

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

}  // namespace

const std::vector<std::string>& smooth_functions() {
  static const std::vector<std::string> all{"sin",  "cos",   "tan",   "asin",  "acos", "atan", "atan2", "sinh", "cosh",
                                            "tanh", "asinh", "acosh", "atanh", "exp",  "log",  "ln",    "sqrt", "abs"};
  return all;
}

const std::vector<std::string>& other_functions() {
  static const std::vector<std::string> all{"min", "max", "sign"};
  return all;
}

NotDifferentiable::NotDifferentiable(const std::string& text, std::string reason_in_words)
    : ExpressionError(fmt::format("\"{}\" is no formula with two derivatives: {} (charts allow + - * / ^ and {})",
                                  shortened(text), reason_in_words, fmt::join(smooth_functions(), " ")),
                      0),
      reason(std::move(reason_in_words)) {}

// muParser keeps the addresses of its variables, so they live as long as the compiled program.
struct Expression::Program {
  mu::Parser parser;
  double x = 0, y = 0;
};

Expression::Expression(double value) : text_(fmt::format("{}", value)), constant_(value) {}

Expression::Expression(std::string text, const Constants& constants) : text_(std::move(text)) {
  check_size(text_);
  compile(constants);
}

Expression Expression::made(std::string text, const Constants& constants) {
  Expression result;
  result.text_ = std::move(text);
  result.compile(constants);
  return result;
}

void Expression::compile(const Constants& constants) {
  auto program = std::make_shared<Program>();
  try {
    program->parser = parser_with(constants);
    program->parser.DefineVar("x", &program->x);
    program->parser.DefineVar("y", &program->y);
    program->parser.SetExpr(text_);
    const double first = program->parser.Eval();
    if (program->parser.GetNumResults() != 1)
      throw ExpressionError(fmt::format("\"{}\" has more than one value", shortened(text_)), 0);
    if (program->parser.GetUsedVar().empty()) {
      constant_ = first;
      return;
    }
  } catch (const mu::ParserError& error) {
    rethrow(error, text_);
  }
  program_ = std::move(program);
}

double Expression::operator()(double x, double y) const {
  if (!program_) return constant_;
  program_->x = x;
  program_->y = y;
  return factor_ * program_->parser.Eval();
}

Expression Expression::scaled(double factor) const {
  Expression result(*this);
  result.text_ = fmt::format("{} * ({})", factor, text_);
  result.constant_ *= factor;
  result.factor_ *= factor;
  return result;
}

void Expression::evaluate(std::span<const double> x, std::span<const double> y, std::span<double> values) const {
  if (!program_) {
    std::ranges::fill(values, constant_);
    return;
  }
  // Not muParser's bulk mode: it starts OpenMP threads for a handful of points.
  for (std::size_t i = 0; i < values.size(); ++i) {
    program_->x = x[i];
    program_->y = y[i];
    values[i] = factor_ * program_->parser.Eval();
  }
}

double evaluate_constant(const std::string& text, const Constants& constants) {
  check_size(text);
  try {
    mu::Parser parser = parser_with(constants);
    parser.SetExpr(text);
    return parser.Eval();
  } catch (const mu::ParserError& error) {
    rethrow(error, text);
  }
}

}  // namespace plastron::geometry
