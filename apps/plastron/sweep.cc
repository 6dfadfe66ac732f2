// plastron sweep CASE --set KEY=A,B,...: solves a case for every combination of values, several at a time, and writes one
// table. Each combination has a folder; a finished one is not solved again.
#include "command_line.hpp"
#include "terminal.hpp"

#include <plastron/config/case.hpp>
#include <plastron/io/finished_results.hpp>
#include <plastron/io/flat_row.hpp>

#include <fmt/ranges.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

namespace plastron::app {

namespace {

namespace fs = std::filesystem;

/// A key with the values that it takes in turn, in TOML.
struct Parameter {
  std::string key;
  std::vector<std::string> values{};
};

/// Splits at commas outside of brackets and quotes.
std::vector<std::string> split_values(std::string_view text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == '{')
      ++depth;
    else if (c == ']' || c == '}')
      --depth;
    if (c == ',' && depth == 0 && quote == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  for (std::string& value : values) {
    value.erase(0, value.find_first_not_of(' '));
    value.erase(value.find_last_not_of(' ') + 1);
  }
  return values;
}

std::vector<Parameter> parameters_of(const std::vector<std::string>& settings) {
  std::vector<Parameter> parameters;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      throw CLI::ValidationError("--set", fmt::format("\"{}\" is not KEY=VALUE,VALUE,...", setting));
    parameters.push_back({setting.substr(0, equals), split_values(std::string_view(setting).substr(equals + 1))});
  }
  return parameters;
}

/// One combination of values.
struct Member {
  std::vector<std::string> values, settings;
  fs::path folder;
  std::string text{};                                     ///< of the case with these values
  std::vector<std::pair<std::string, fs::path>> files{};  ///< that the case names
  bool is_refused = false;                                ///< the solver found the case wrong
};

/// Returns all combinations; the last parameter changes fastest. Throws config::CaseErrors for a combination that cannot be read.
std::vector<Member> members_of(const SweepOptions& options, const std::vector<Parameter>& parameters) {
  std::vector<Member> members(1);
  for (const Parameter& parameter : parameters) {
    std::vector<Member> longer;
    for (const Member& member : members)
      for (const std::string& value : parameter.values) {
        longer.push_back(member);
        longer.back().values.push_back(value);
        longer.back().settings.push_back(parameter.key + "=" + value);
      }
    members = std::move(longer);
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    members[i].folder = options.output / fmt::format("{:04}", i + 1);
    config::Case c = config::read_case(options.case_file, members[i].settings);
    members[i].text = std::move(c.text);
    members[i].files = std::move(c.files);
  }
  return members;
}

/// Returns the results of a member; null if it was not solved, or if another case was solved there.
io::Json results_of(const Member& member) { return io::finished_results(member.folder, member.text, member.files); }

volatile sig_atomic_t was_interrupted = 0;
extern "C" void note_end(int) { was_interrupted = 1; }

/// A file without a name, for what the solver of a member tells.
using Messages = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Starts the solver for a member, with its warnings and errors into `messages`, and returns its process.
pid_t start(const Member& member, const SweepOptions& options, const fs::path& program, const Messages& messages) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (messages) dup2(fileno(messages.get()), STDERR_FILENO);
  std::vector<std::string> words{
      program.string(), "run", options.case_file.string(), "--output", member.folder.string(), "--quiet",
      "--threads",      "1"};
  if (!options.with_reports) words.emplace_back("--no-report");
  for (const std::string& setting : member.settings) words.insert(words.end(), {"--set", setting});
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(program.c_str(), arguments.data());
  _exit(internal_error);
}

/// Prints the messages of a member, if there are any, below its folder and values.
void print_messages(const Member& member, const Messages& messages) {
  if (!messages) return;
  std::rewind(messages.get());
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), messages.get()))
    text.append(part.data(), size);
  if (!text.empty()) fmt::print(stderr, "{} ({}):\n{}", member.folder.string(), fmt::join(member.settings, ", "), text);
}

/// Solves members, `options.jobs` at a time. Returns false after an interruption.
bool solve_all(const std::vector<Member*>& members, const SweepOptions& options, const fs::path& program) {
  struct sigaction action {};
  action.sa_handler = note_end;
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
  std::map<pid_t, std::pair<Member*, Messages>> running;
  std::size_t next = 0, done = 0;
  while (!running.empty() || (next < members.size() && was_interrupted == 0)) {
    if (next < members.size() && was_interrupted == 0 && running.size() < static_cast<std::size_t>(options.jobs)) {
      Messages messages(std::tmpfile(), std::fclose);
      const pid_t child = start(*members[next], options, program, messages);
      if (child < 0) return false;
      running.emplace(child, std::pair(members[next++], std::move(messages)));
      continue;
    }
    int state = 0;
    const pid_t child = waitpid(-1, &state, 0);
    if (child < 0 && errno != EINTR) break;
    if (child < 0) continue;
    const auto ended = running.extract(child);
    if (ended.empty()) continue;
    const auto& [of_child, messages] = ended.mapped();
    Member& member = *of_child;
    member.is_refused = WIFEXITED(state) && WEXITSTATUS(state) == bad_input;
    if (!options.quiet)
      app::print("{:>5} of {}  {}  {}\n", ++done, members.size(), member.folder.string(),
                 fmt::format("{}", fmt::join(member.settings, "  ")));
    std::fflush(stdout);
    print_messages(member, messages);
  }
  return was_interrupted == 0;
}

/// Returns the text of a value in quotes, or the value.
std::string unquoted(const std::string& value) {
  const bool is_text = value.size() > 1 && (value[0] == '"' || value[0] == '\'') && value.back() == value[0];
  return is_text ? value.substr(1, value.size() - 2) : value;
}

/// Returns the table: a line of names, then one line for each member with its results, which are null if there are none.
std::string table_of(const std::vector<Member>& members, const std::vector<io::Json>& results,
                     const std::vector<Parameter>& parameters) {
  std::vector<std::string> columns;
  std::vector<std::map<std::string, std::string>> cells;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const char* without = members[i].is_refused ? "refused" : "not_solved";
    const io::Row row = results[i].is_null() ? io::Row{{"status", without}} : io::result_row(results[i]);
    for (const auto& [name, text] : row)
      if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
    cells.emplace_back(row.begin(), row.end());
  }
  std::string text;
  for (const Parameter& parameter : parameters) text += io::csv_cell(parameter.key) + ",";
  text += fmt::format("{}\n", fmt::join(columns, ","));
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (const std::string& value : members[i].values) text += io::csv_cell(unquoted(value)) + ",";
    for (const std::string& column : columns)
      text += io::csv_cell(cells[i][column]) + (column == columns.back() ? "\n" : ",");
  }
  return text;
}

}  // namespace

ExitCode sweep(const SweepOptions& options) {
  const fs::path program = find_program("plastron-solver");
  const auto parameters = parameters_of(options.settings);
  std::vector<Member> members = members_of(options, parameters);
  std::error_code error;
  fs::create_directories(options.output, error);
  if (error) {
    print_error("error: {} cannot be made: {}\n", options.output.string(), error.message());
    return bad_input;
  }
  std::vector<Member*> open;
  for (Member& member : members)
    if (results_of(member).is_null()) open.push_back(&member);
  if (!options.quiet && open.size() < members.size())
    print("{} of {} cases are solved already\n", members.size() - open.size(), members.size());
  const bool is_complete = solve_all(open, options, program);
  const fs::path table = options.table.empty() ? options.output / "table.csv" : options.table;
  std::vector<io::Json> results;
  std::ranges::transform(members, std::back_inserter(results), results_of);
  std::ofstream stream(table, std::ios::binary);
  stream << table_of(members, results, parameters);
  if (!stream.flush()) {
    print_error("error: {} cannot be written\n", table.string());
    return bad_input;
  }
  if (!options.quiet) print("table             {}\n", table.string());
  if (!is_complete) {
    print_error("interrupted: the same command goes on with the cases that are not solved\n");
    return not_converged;
  }
  const auto is_solved = [](const io::Json& one) { return !one.is_null() && one.value("status", "") == "solved"; };
  return std::ranges::all_of(results, is_solved) ? solved : not_converged;
}

}  // namespace plastron::app
