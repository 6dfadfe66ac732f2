// plastron: reads the command line and the case file, then starts plastron-solver or plastron-study in the same
// process. The solver's 200 shared libraries alone take longer to load than a response to help, a wrong argument or a
// mistake in a case file may take.
#include "command_line.hpp"
#include "terminal.hpp"

#include <plastron/config/case.hpp>
#include <plastron/config/schema.hpp>
#include <plastron/io/results_schema.hpp>

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <new>
#include <optional>
#include <thread>

namespace plastron::app {

namespace {

/// Address space that the solver's libraries need before it starts. A loader without enough space reports shared
/// objects, and MPI may wait forever.
constexpr rlim_t least_address_space = rlim_t{1} << 30;

bool has_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= least_address_space)
    return true;
  print_error(
      "error: not enough memory: the address space is limited to {} MB (ulimit -v), at least {} MB are needed\n",
      limit.rlim_cur >> 20, least_address_space >> 20);
  return false;
}

/// Starts the other program. It returns only with an error.
ExitCode hand_over(const CommandLine& line, char** argv) {
  if (!has_address_space()) return internal_error;
  const bool is_study = line.study->parsed() || line.commands.compare->parsed();
  const auto program = find_program(is_study ? "plastron-study" : "plastron-solver");
  execv(program.c_str(), argv);
  const char* advice = is_study && errno == ENOENT ? "; `cmake --build --preset release` builds it" : "";
  print_error("error: {} cannot be started: {}{}\n", program.string(), std::strerror(errno), advice);
  return internal_error;
}

/// Waits so that the first process can print. All processes of a job end in the same way, but a launcher ends all when
/// one ends.
ExitCode refused() {
  if (!is_first_rank()) std::this_thread::sleep_for(std::chrono::milliseconds(500));
  return bad_input;
}

void tell(const config::CaseErrors& errors) {
  if (!is_logging_events()) {
    if (is_first_rank()) print_text(stderr, errors.format());
    return;
  }
  for (const config::Mistake& m : errors.mistakes())
    log_event("mistake", {{"file", m.file},
                          {"line", m.line},
                          {"column", m.column},
                          {"what", m.what},
                          {"allowed", m.allowed},
                          {"advice", m.advice}});
  log_event("exit", {{"exit_code", static_cast<int>(bad_input)}});
}

/// Prints the JSON Schema of the "case" file or of "results".json.
ExitCode print_schema(const std::string& of) {
  const auto schema = of == "results" ? io::results_schema() : config::case_schema();
  if (is_first_rank()) print_raw(stdout, schema.dump(2) + "\n");
  return solved;
}

/// Runs a command that needs no computation; returns nothing for other commands.
std::optional<ExitCode> answer_question(const CommandLine& line) {
  const Questions& q = line.questions;
  if (line.asked.explain->parsed()) return explain(q.word);
  if (line.asked.schema->parsed()) return print_schema(q.schema);
  if (line.asked.completion->parsed()) return print_completion(line.program, q.shell);
  if (line.asked.plot->parsed()) return plot(q.results);
  if (line.asked.manual->parsed()) return print_manual_page(line.program);
  if (line.asked.make_new->parsed()) return new_case(q.name, q.example, q.is_listing);
  return {};
}

}  // namespace

std::filesystem::path find_program(const char* name) {
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const auto in_libexec = folder.parent_path() / "libexec" / "plastron" / name;
  const auto beside = folder / name;
  return !std::filesystem::exists(beside, error) && std::filesystem::exists(in_libexec, error) ? in_libexec : beside;
}

int front(int argc, char** argv) {
  secure_standard_streams();
  CommandLine line;
  try {
    line.program.parse(argc, argv);
    if (const auto answered = answer_question(line)) return *answered;
    if (line.sweep->parsed()) return has_address_space() ? sweep(line.sweep_options) : internal_error;
    log_start(line);
    if (!line.commands.verify->parsed() && !line.parts->parsed()) {  // they have no case file
      const bool is_study = line.study->parsed();
      [[maybe_unused]] const config::Case read =
          config::read_case(is_study ? line.study_options.case_file : line.options.case_file,
                            is_study ? line.study_options.settings : line.options.settings);
    }
  } catch (const CLI::ParseError& reply) {
    return answer(line.program, reply) == solved ? solved : refused();
  } catch (const config::CaseErrors& errors) {
    tell(errors);
    return refused();
  } catch (const std::bad_alloc&) {
    print_error("error: not enough memory to read the case\n");
    return internal_error;
  }
  return hand_over(line, argv);
}

}  // namespace plastron::app

int main(int argc, char** argv) { return plastron::app::front(argc, argv); }
