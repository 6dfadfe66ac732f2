// The commands and their options as a list, taken from the parser. Completions and the manual page are made from it.
#pragma once
#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace plastron::app {

/// Kinds of values of an argument.
enum class Accepts { nothing, anything, number, file, directory, setting, words };

struct Argument {
  std::vector<std::string> names{};  ///< "-o", "--output"; for a positional argument "CASE"
  std::string meaning{}, fallback{};
  Accepts accepts = Accepts::nothing;
  /// For Accepts::words and setting: known values; others may be possible. For Accepts::file: endings of its name.
  std::vector<std::string> words{};
  bool is_required = false;
};

struct Command {
  std::string name{}, meaning{}, footer{};
  std::vector<Argument> positionals{}, options{};
};

std::vector<Command> command_list(const CLI::App& program);

}  // namespace plastron::app
