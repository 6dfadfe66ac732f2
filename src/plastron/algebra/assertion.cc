#include <fmt/core.h>
#include <plastron/algebra/assertion.hpp>

#include <cstdio>
#include <cstdlib>

namespace plastron::algebra {

void assertion_failed(const char* condition, const char* names, const std::string& values, const char* file, int line) {
  fmt::print(stderr, "{}:{}: assertion failed: {}", file, line, condition);
  if (!values.empty()) fmt::print(stderr, "; {} = {}", names, values);
  fmt::print(stderr, "\n");
  std::fflush(stderr);
  std::abort();
}

}  // namespace plastron::algebra
