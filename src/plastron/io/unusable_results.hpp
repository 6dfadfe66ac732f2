// Error of results from outside that cannot be examined.
#pragma once
#include <stdexcept>

namespace plastron::io {

/// Missing or wrong parts of results, in words for the user.
struct UnusableResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace plastron::io
