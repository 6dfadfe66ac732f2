#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/quotation.hpp>

#include <fmt/format.h>

#include <algorithm>

#include "parser.hpp"

namespace plastron::geometry {

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

std::map<std::string, double> Expression::constants() const {
  return program_ ? program_->parser.GetConst() : std::map<std::string, double>();
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
  // muParser's bulk mode is not used: it starts OpenMP threads for a few points.
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
