// Assertions on preconditions inside the code. The message contains the values that violate the condition:
//   PLASTRON_ASSERT(x.block() == y.block(), x.block(), y.block());
// They are active where NDEBUG is not defined, which is in the sanitizer build, and cost nothing elsewhere. They do not
// check mistakes of users: these are exceptions at the interface.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

namespace plastron::algebra {

/// Prints the condition, the place and "names = values" to stderr and aborts. The library prints nothing else.
[[noreturn]] inline void assertion_failed(const char* condition, const char* names, const std::string& values,
                                          const char* file, int line) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s", file, line, condition);
  if (!values.empty()) std::fprintf(stderr, "; %s = %s", names, values.c_str());
  std::fprintf(stderr, "\n");
  std::fflush(stderr);
  std::abort();
}

/// Returns the values, separated by commas.
template <class... Values>
std::string listed(const Values&... values) {
  std::ostringstream text;
  [[maybe_unused]] const char* separator = "";
  ((text << separator << values, separator = ", "), ...);
  return text.str();
}

}  // namespace plastron::algebra

// This is a macro because only a macro knows the text of its arguments and can leave them unevaluated.
#ifdef NDEBUG
#define PLASTRON_ASSERT(condition, ...) static_cast<void>(sizeof((condition) ? 1 : 0))
#else
#define PLASTRON_ASSERT(condition, ...)                                          \
  ((condition) ? static_cast<void>(0)                                            \
               : ::plastron::algebra::assertion_failed(#condition, #__VA_ARGS__, \
                                                       ::plastron::algebra::listed(__VA_ARGS__), __FILE__, __LINE__))
#endif
