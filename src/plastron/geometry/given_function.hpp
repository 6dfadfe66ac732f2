// Functions that a program gives under a name, for cases that no text can describe. A text that is such a name stands for
// the function. Texts have their derivatives from algebra; a given function has its own.
#pragma once
#include <plastron/geometry/place.hpp>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace plastron::geometry {

/// A function of x, y, or of X, Y, Z, or of all of them.
struct GivenFunction {
  bool uses_parameters = false;      ///< x or y
  bool uses_space = false;           ///< X, Y or Z
  std::array<bool, 3> depends_on{};  ///< whether it is a function of X, of Y, of Z
  /// Sets values[k * places.size() + i] to the derivative `first` + k at place i, for `count` derivatives. 0 is the value. 1 to
  /// 5 are d/dx, d/dy, d2/dx2, d2/dxdy, d2/dy2; or, for a function of space, 1 to 9 are d/dX, d/dY, d/dZ, d2/dX2, d2/dXdY,
  /// d2/dXdZ, d2/dY2, d2/dYdZ, d2/dZ2. May throw FunctionError.
  std::function<void(std::span<const Place> places, int first, int count, std::span<double> values)> evaluate{};
};

/// A given function that failed, in words for the user.
struct FunctionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Gives a function a name, or replaces the one that has it.
void give_function(const std::string& name, GivenFunction function);
/// Forgets a name. Expressions that use the function keep it.
void forget_function(const std::string& name);
/// Whether some function is given.
bool has_given_functions();
/// Calls the functions that a case names for their values at places of its shell. Functions that take differences learn from them
/// how large the shell is.
void show_places(std::string_view case_text, std::span<const Place> places);
/// Returns the function with the text as its name; null if there is none.
std::shared_ptr<const GivenFunction> given_function(std::string_view text);

}  // namespace plastron::geometry
