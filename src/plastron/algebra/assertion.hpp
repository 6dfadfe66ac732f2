// Assertions on what one part of the code promises another, with the values that break the promise in the message:
//   PLASTRON_ASSERT(x.block() == y.block(), x.block(), y.block());
// They are live where NDEBUG is not defined, that is in the sanitizer build, and cost nothing elsewhere. Mistakes of users are no
// business of theirs: those are exceptions at the edge.
#pragma once
#include <sstream>
#include <string>

namespace plastron::algebra {

/// Prints the condition, the place and "names = values" to stderr and aborts: the one thing that the library prints.
[[noreturn]] void assertion_failed(const char* condition, const char* names, const std::string& values,
                                   const char* file, int line);

/// The values one after the other, separated by commas.
template <class... Values>
std::string listed(const Values&... values) {
  std::ostringstream text;
  [[maybe_unused]] const char* separator = "";
  ((text << separator << values, separator = ", "), ...);
  return text.str();
}

}  // namespace plastron::algebra

// A macro, since only a macro knows the text of its arguments and can leave them unevaluated.
#ifdef NDEBUG
#define PLASTRON_ASSERT(condition, ...) static_cast<void>(sizeof((condition) ? 1 : 0))
#else
#define PLASTRON_ASSERT(condition, ...)                                          \
  ((condition) ? static_cast<void>(0)                                            \
               : ::plastron::algebra::assertion_failed(#condition, #__VA_ARGS__, \
                                                       ::plastron::algebra::listed(__VA_ARGS__), __FILE__, __LINE__))
#endif
