// The exit codes of the command line (docs/user-guide.md).
#pragma once

namespace plastron::app {

enum ExitCode : int { solved = 0, bad_input = 2, not_converged = 3, not_verified = 3, internal_error = 4 };

}  // namespace plastron::app
