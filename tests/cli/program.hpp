// Runs the program itself, as a user would, in a scratch directory.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plastron::cli {

namespace fs = std::filesystem;

/// How a run of the program ended.
struct Outcome {
  int exit_code = -1;  ///< -1 if a signal ended it
  bool timed_out = false;
  double seconds = 0;
  std::string output;  ///< standard output and standard error together
};

/// Waits for the end, but not longer than `patience` seconds; then the run is killed.
Outcome plastron(const std::vector<std::string>& arguments, const fs::path& directory, double patience = 60);

/// A line of the shell, in which $PLASTRON is the program; for pipes, limits and closed streams.
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
  /// Waits for the end, and not longer than so many seconds: the exit code, or minus the signal that ended it; nothing if it
  /// goes on.
  std::optional<int> end(double patience);
  std::string output() const;  ///< so far

 private:
  fs::path log_, session_;  // what it prints, and where its MPI keeps its files
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
/// All files below a directory, by their path relative to it; empty if there is none.
std::vector<std::string> files_below(const fs::path& directory);

}  // namespace plastron::cli
