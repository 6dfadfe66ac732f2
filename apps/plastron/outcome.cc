#include "outcome.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

namespace plastron::app {

namespace fs = std::filesystem;

std::string obstacle_to_writing(const fs::path& directory) {
  std::error_code ignored;
  if (fs::exists(directory, ignored)) {
    if (!fs::is_directory(directory, ignored)) return "it is a file; name a directory";
    return access(directory.c_str(), W_OK | X_OK) == 0 ? "" : "it is not writable";
  }
  fs::path parent = fs::absolute(directory, ignored).parent_path();
  while (!fs::exists(parent, ignored) && parent.has_relative_path()) parent = parent.parent_path();
  if (!fs::is_directory(parent, ignored)) return fmt::format("{} is a file", parent.string());
  return access(parent.c_str(), W_OK | X_OK) == 0 ? "" : fmt::format("{} is not writable", parent.string());
}

ExitCode exit_code(contact::Status status) {
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
