// The error of a file that cannot be read, in words for the user.
#pragma once
#include <stdexcept>

namespace plastron::geometry {

/// A file that cannot be read, or a line of it that is wrong. The text names the file.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace plastron::geometry
