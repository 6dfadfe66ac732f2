// A scalar function of a place on the mid-surface, written by the user as text and evaluated by muParser.
#pragma once
#include <plastron/geometry/expression_text.hpp>
#include <plastron/geometry/place.hpp>

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plastron::geometry {

/// The functions known in expressions that have two derivatives, and the other known functions.
const std::vector<std::string>& smooth_functions();
const std::vector<std::string>& other_functions();

struct GivenFunction;

/// f(x, y, X, Y, Z). Known names: x, y, X, Y, Z, pi, the constants; + - * / ^, comparisons, c ? a : b, and the functions
/// above.
class Expression {
 public:
  /// Makes the zero function.
  Expression() : Expression(0.0) {}
  /// Makes the constant function `value`.
  explicit Expression(double value);
  /// The text may be the name of a given function (given_function.hpp). Throws ExpressionError.
  Expression(std::string text, const Constants& constants);
  /// Makes an expression from a text written by the program, without limit of length.
  static Expression made(std::string text, const Constants& constants);

  double operator()(const Place& place) const;
  /// Precondition: the text has none of X, Y, Z.
  double operator()(double x, double y) const { return (*this)(Place{x, y}); }
  /// Sets values[i] = f(places[i]).
  void evaluate(std::span<const Place> places, std::span<double> values) const;

  /// Returns the function `factor` f.
  Expression scaled(double factor) const;

  bool is_constant() const { return !program_; }
  bool uses_parameters() const;  ///< whether the text has x or y
  bool uses_space() const;       ///< whether the text has X, Y or Z
  const std::string& text() const { return text_; }
  /// Values of the names in the text other than variables; empty for a constant function.
  std::map<std::string, double> constants() const;

 private:
  struct Program;
  void compile(const Constants& constants);
  std::string text_;
  double constant_ = 0;
  double factor_ = 1;  // factor of the program's value
  std::shared_ptr<Program> program_;
};

/// Returns the value of a text that may use the constants but no variables. Throws ExpressionError.
double evaluate_constant(const std::string& text, const Constants& constants);

}  // namespace plastron::geometry
