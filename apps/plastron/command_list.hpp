// The commands and their options as a list, read off the parser: completions and the manual page are made from it.
#pragma once
#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace plastron::app {

/// What may stand for an argument.
enum class Accepts { nothing, anything, number, case_file, directory, setting, words };

struct Argument {
  std::vector<std::string> names{};  ///< "-o", "--output"; of a positional one "CASE"
  std::string meaning{}, fallback{};
  Accepts accepts = Accepts::nothing;
  std::vector<std::string> words{};  ///< Accepts::words, setting: what they are; may be more than these
  bool is_required = false;
};

struct Command {
  std::string name{}, meaning{}, footer{};
  std::vector<Argument> positionals{}, options{};
};

std::vector<Command> command_list(const CLI::App& program);

}  // namespace plastron::app
