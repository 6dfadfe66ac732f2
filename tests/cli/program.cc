#include "cli/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace plastron::cli {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The program must not believe that it belongs to the MPI job of the test program. Alone it needs none of MPI's
/// helpers, which take longer to start than a case takes to read.
///
/// Open MPI removes its session directory at the end, even while another process creates its own in it. So each
/// process gets its own place.
std::vector<std::string> environment(const fs::path& session) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    const auto begins = [&](const char* prefix) { return text.starts_with(prefix); };
    if (!begins("OMPI_") && !begins("PMIX_") && !begins("OMP_NUM_THREADS=")) all.push_back(text);
  }
  all.emplace_back("OMP_NUM_THREADS=1");
  all.emplace_back("PLASTRON=" PLASTRON_PROGRAM);
  all.emplace_back("OMPI_MCA_orte_tmpdir_base=" + session.string());
  for (const char* setting : {"OMPI_MCA_ess_singleton_isolated=1", "OMPI_MCA_pml=ob1", "OMPI_MCA_btl=self",
                              "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"})
    all.emplace_back(setting);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& t : texts) all.push_back(t.data());
  all.push_back(nullptr);
  return all;
}

/// A name in the system's temporary directory that is unique to this process and call.
fs::path fresh_path(const char* ending) {
  static std::atomic<int> number = 0;
  return fs::temp_directory_path() /
         ("plastron-cli-" + std::to_string(getpid()) + "-" + std::to_string(++number) + ending);
}

std::vector<std::string> plastron_words(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{PLASTRON_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

pid_t start(std::vector<std::string> words, const fs::path& directory, const fs::path& log, const fs::path& session) {
  fs::create_directories(session);
  std::vector<std::string> variables = environment(session);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t process = -1;
  const int error =
      posix_spawn(&process, words[0].c_str(), &actions, nullptr, pointers(words).data(), pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error) throw std::runtime_error("cannot start " + words[0] + ": " + std::strerror(error));
  return process;
}

Outcome outcome_of(const std::vector<std::string>& words, const fs::path& directory, double patience);

}  // namespace

Outcome plastron(const std::vector<std::string>& arguments, const fs::path& directory, double patience) {
  return outcome_of(plastron_words(arguments), directory, patience);
}

Outcome shell(const std::string& line, const fs::path& directory, double patience) {
  return outcome_of({"/bin/bash", "-c", line}, directory, patience);
}

namespace {

Outcome outcome_of(const std::vector<std::string>& words, const fs::path& directory, double patience) {
  const fs::path log = fresh_path(".log"), session = fresh_path(".mpi");
  Outcome outcome;
  const auto begin = Clock::now();
  const pid_t process = start(words, directory, log, session);
  int status = 0;
  while (waitpid(process, &status, WNOHANG) == 0) {
    if (!outcome.timed_out && seconds_since(begin) > patience) {
      outcome.timed_out = true;
      ::kill(process, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  outcome.seconds = seconds_since(begin);
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  outcome.output = text_of(log);
  fs::remove(log);
  std::error_code ignored;
  fs::remove_all(session, ignored);
  return outcome;
}

}  // namespace

Running::Running(const std::vector<std::string>& arguments, const fs::path& directory)
    : log_(fresh_path(".log")),
      session_(fresh_path(".mpi")),
      process_(start(plastron_words(arguments), directory, log_, session_)) {}

void Running::send(int signal) {
  if (process_ > 0) ::kill(process_, signal);
}

std::optional<int> Running::end(double patience) {
  const auto begin = Clock::now();
  int status = 0;
  while (waitpid(process_, &status, WNOHANG) == 0) {
    if (seconds_since(begin) > patience) return {};
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

std::string Running::output() const { return text_of(log_); }

bool Running::is_alive() {
  if (process_ > 0 && waitpid(process_, nullptr, WNOHANG) != 0) process_ = -1;
  return process_ > 0;
}

void Running::kill() {
  if (is_alive()) {
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  std::error_code ignored;
  fs::remove_all(session_, ignored);
  fs::remove(log_, ignored);
}

Scratch::Scratch() {
  std::string name = (fs::temp_directory_path() / "plastron-cli-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("cannot make " + name);
  path = name;
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

fs::path Scratch::write(const std::string& name, const std::string& text) const {
  std::ofstream(path / name) << text;
  return path / name;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> files_below(const fs::path& directory) {
  std::vector<std::string> files;
  if (fs::exists(directory))
    for (const auto& entry : fs::recursive_directory_iterator(directory))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), directory).string());
  std::ranges::sort(files);
  return files;
}

}  // namespace plastron::cli
