// Runs the program itself, as a user would, in a scratch directory.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plastron::cli {

namespace fs = std::filesystem;

/// The end of a run of the program.
struct Outcome {
  int exit_code = -1;  ///< -1 if a signal ended it
  bool timed_out = false;
  double seconds = 0;
  std::string output;  ///< standard output and standard error together
};

/// Waits for the end, at most `patience` seconds; then the run is killed.
Outcome plastron(const std::vector<std::string>& arguments, const fs::path& directory, double patience = 60);

/// A shell command in which $PLASTRON is the program; for pipes, limits and closed streams.
Outcome shell(const std::string& line, const fs::path& directory, double patience = 60);

/// A run in the background.
class Running {
 public:
  Running(const std::vector<std::string>& arguments, const fs::path& directory);
  ~Running() { kill(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  bool is_alive();
  void kill();  ///< SIGKILL, and waits for the end
  void send(int signal);
  /// Waits for the end, at most so many seconds. Returns the exit code, or minus the signal that ended it; empty if it still
  /// runs.
  std::optional<int> end(double patience);
  std::string output() const;  ///< so far

 private:
  fs::path log_, session_;  // its output, and the place of its MPI session
  pid_t process_ = -1;
};

/// A fresh directory, removed at the end.
struct Scratch {
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path write(const std::string& name, const std::string& text) const;
  fs::path path;
};

std::string text_of(const fs::path& file);
/// All files in a directory, by their relative path; empty if the directory does not exist.
std::vector<std::string> files_below(const fs::path& directory);

}  // namespace plastron::cli
