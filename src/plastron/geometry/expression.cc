#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/given_function.hpp>
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
  Place at{};
  bool uses_parameters = false, uses_space = false;
  std::shared_ptr<const GivenFunction> given{};  // in the place of the parser
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
  if (auto given = given_function(text_)) {
    program_ = std::make_shared<Program>();
    program_->uses_parameters = given->uses_parameters;
    program_->uses_space = given->uses_space;
    program_->given = std::move(given);
    return;
  }
  auto program = std::make_shared<Program>();
  try {
    program->parser = parser_with(constants);
    Place& at = program->at;
    for (const auto& [name, value] : {std::pair("x", &at.x), {"y", &at.y}, {"X", &at.X}, {"Y", &at.Y}, {"Z", &at.Z}})
      program->parser.DefineVar(name, value);
    program->parser.SetExpr(text_);
    const double first = program->parser.Eval();
    if (program->parser.GetNumResults() != 1)
      throw ExpressionError(fmt::format("\"{}\" has more than one value", shortened(text_)), 0);
    const auto& used = program->parser.GetUsedVar();
    if (used.empty()) {
      constant_ = first;
      return;
    }
    program->uses_parameters = used.contains("x") || used.contains("y");
    program->uses_space = used.contains("X") || used.contains("Y") || used.contains("Z");
  } catch (const mu::ParserError& error) {
    rethrow(error, text_);
  }
  program_ = std::move(program);
}

std::map<std::string, double> Expression::constants() const {
  return program_ && !program_->given ? program_->parser.GetConst() : std::map<std::string, double>();
}

bool Expression::uses_parameters() const { return program_ && program_->uses_parameters; }
bool Expression::uses_space() const { return program_ && program_->uses_space; }

double Expression::operator()(const Place& place) const {
  if (!program_) return constant_;
  if (program_->given) {
    double value = 0;
    program_->given->evaluate({&place, 1}, 0, 1, {&value, 1});
    return factor_ * value;
  }
  program_->at = place;
  return factor_ * program_->parser.Eval();
}

Expression Expression::scaled(double factor) const {
  Expression result(*this);
  result.text_ = fmt::format("{} * ({})", factor, text_);
  result.constant_ *= factor;
  result.factor_ *= factor;
  return result;
}

void Expression::evaluate(std::span<const Place> places, std::span<double> values) const {
  if (program_ && program_->given) {
    program_->given->evaluate(places.first(values.size()), 0, 1, values);
    for (double& value : values) value *= factor_;
    return;
  }
  // muParser's bulk mode is not used: it starts OpenMP threads for a few points.
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (*this)(places[i]);
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
