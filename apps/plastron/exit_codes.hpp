// The exit codes of the command line (docs/user-guide.md).
#pragma once
#include <plastron/contact/problem.hpp>

namespace plastron::app {

enum ExitCode : int { solved = 0, bad_input = 2, not_converged = 3, not_verified = 3, internal_error = 4 };

constexpr ExitCode exit_code(contact::Status status) {
  switch (status) {
    case contact::Status::solved:
      return solved;
    case contact::Status::infeasible:
      return bad_input;
    default:
      return not_converged;
  }
}

}  // namespace plastron::app
