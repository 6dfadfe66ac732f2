// Results that somebody hands over and that cannot even be examined.
#pragma once
#include <stdexcept>

namespace plastron::io {

/// What is not there or not as it should be, in words for the user.
struct UnusableResults : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace plastron::io
