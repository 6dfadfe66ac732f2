// What the texts of expressions have in common: constants, errors, limits.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace plastron::geometry {

/// Named constants of a case, in the order of their definition.
using Constants = std::vector<std::pair<std::string, double>>;

/// Error for a text that is no valid expression. `position` is the offset in the text of the first wrong character.
struct ExpressionError : std::invalid_argument {
  ExpressionError(const std::string& message, std::size_t position_in_text)
      : std::invalid_argument(message), position(position_in_text) {}
  std::size_t position;
};

/// Error for an expression that cannot be differentiated twice, with the reason.
struct NotDifferentiable : ExpressionError {
  NotDifferentiable(const std::string& text, std::string reason_in_words);
  std::string reason;
};

/// Limits of an expression, so that reading one takes little time and stack.
inline constexpr std::size_t longest_expression = 4000;  ///< characters
inline constexpr std::size_t deepest_brackets = 50;

}  // namespace plastron::geometry
