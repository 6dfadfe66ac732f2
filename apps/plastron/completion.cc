// plastron completion: scripts for bash, zsh and fish that complete commands, options, case files and words of this
// program.
#include "command_line.hpp"
#include "command_list.hpp"
#include "terminal.hpp"

#include <algorithm>

namespace plastron::app {

namespace {

std::string names_of(const std::vector<Argument>& options) {
  std::string names;
  for (const Argument& option : options)
    for (const std::string& name : option.names) names += (names.empty() ? "" : " ") + name;
  return names;
}

std::string command_words(const std::vector<Command>& commands) {
  std::string names;
  for (const Command& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

/// Returns the text in single quotes, for all three shells.
std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string(R"('\'')") : std::string(1, c);
  return result + "'";
}

// ---- bash ------------------------------------------------------------------------------------------------------

/// Returns the line that fills COMPREPLY.
std::string bash_offer(const Argument& argument) {
  switch (argument.accepts) {
    case Accepts::file:
      return fmt::format("_plastron_files {}", fmt::join(argument.words, " "));
    case Accepts::directory:
      return "_plastron_directories";
    case Accepts::setting:
      return fmt::format("_plastron_words {}; compopt -o nospace 2>/dev/null",
                         in_quotes(fmt::format("{}", fmt::join(argument.words, " "))));
    case Accepts::words:
      return fmt::format("_plastron_words {}", in_quotes(fmt::format("{}", fmt::join(argument.words, " "))));
    default:
      return ":";
  }
}

constexpr std::string_view bash_begin = R"(# bash completion of plastron, made by `plastron completion bash`
_plastron_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }
_plastron_directories() { compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$cur"); }
_plastron_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur"; for ending in "$@"; do compgen -f -X "!*.$ending" -- "$cur"; done)
}
_plastron() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command='' given=0 i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} == -* ]]; then continue; fi
    if [[ -z $command ]]; then
      command=${COMP_WORDS[i]}
    elif [[ " $(_plastron_valued "$command") " != *" ${COMP_WORDS[i-1]} "* ]]; then
      ((++given))
    fi
  done
)";

std::string bash(const std::vector<Command>& commands) {
  std::string valued = "# The options of a command that take a value.\n_plastron_valued() {\n  case $1 in\n";
  std::string body = fmt::format("  if [[ -z $command ]]; then _plastron_words '{} --help --version'; return; fi\n",
                                 command_words(commands));
  body += "  case $command:$prev in\n";
  for (const Command& command : commands) {
    std::vector<std::string> taking;
    for (const Argument& option : command.options) {
      if (option.accepts == Accepts::nothing) continue;
      std::string patterns;
      for (const std::string& name : option.names) {
        taking.push_back(name);
        patterns += fmt::format("{}{}:{}", patterns.empty() ? "" : "|", command.name, name);
      }
      body += fmt::format("    {}) {}; return ;;\n", patterns, bash_offer(option));
    }
    valued += fmt::format("    {}) echo '{}' ;;\n", command.name, fmt::join(taking, " "));
  }
  body += "  esac\n  case $command in\n";
  for (const Command& command : commands) {
    body += fmt::format("    {})\n      if [[ $cur == -* ]]; then _plastron_words '{}'; return; fi\n", command.name,
                        names_of(command.options));
    for (std::size_t i = 0; i < command.positionals.size(); ++i)
      body += fmt::format("      if ((given == {})); then {}; fi\n", i, bash_offer(command.positionals[i]));
    body += "      ;;\n";
  }
  return valued + "  esac\n}\n" + std::string(bash_begin) + body + "  esac\n}\ncomplete -F _plastron plastron\n";
}

// ---- zsh -------------------------------------------------------------------------------------------------------

/// Returns a text for [...] in a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : text) result += (c == '[' || c == ']' || c == ':' || c == '\\' ? "\\" : "") + std::string(1, c);
  return result;
}

std::string zsh_action(const Argument& argument) {
  switch (argument.accepts) {
    case Accepts::file:
      return fmt::format("_files -g \"*.({})\"", fmt::join(argument.words, "|"));
    case Accepts::directory:
      return "_files -/";
    case Accepts::setting:
      return fmt::format("compadd -S \"\" -- {}", fmt::join(argument.words, " "));
    case Accepts::words:
      return fmt::format("({})", fmt::join(argument.words, " "));
    default:
      return " ";
  }
}

std::string zsh_option(const Argument& option) {
  std::string all;
  for (const std::string& name : option.names) {
    std::string specification = option.accepts == Accepts::setting ? "*" : "";
    specification += fmt::format("{}[{}]", name, zsh_text(option.meaning));
    if (option.accepts != Accepts::nothing) specification += fmt::format(":value:{}", zsh_action(option));
    all += fmt::format(" \\\n        {}", in_quotes(specification));
  }
  return all;
}

std::string zsh(const std::vector<Command>& commands) {
  std::string text = "#compdef plastron\n# zsh completion of plastron, made by `plastron completion zsh`\n";
  text += "_plastron() {\n  local -a commands\n  commands=(\n";
  for (const Command& c : commands) text += "    " + in_quotes(c.name + ":" + zsh_text(c.meaning)) + "\n";
  text += "  )\n  if ((CURRENT == 2)); then\n    _describe command commands\n    return\n  fi\n";
  text += "  local command=$words[2]\n  shift words\n  ((--CURRENT))\n  case $command in\n";
  for (const Command& c : commands) {
    text += fmt::format("    {})\n      _arguments", c.name);
    for (const Argument& option : c.options) text += zsh_option(option);
    for (std::size_t i = 0; i < c.positionals.size(); ++i)
      text += fmt::format(" \\\n        {}", in_quotes(fmt::format("{}:{}:{}", i + 1, c.positionals[i].names[0],
                                                                   zsh_action(c.positionals[i]))));
    text += "\n      ;;\n";
  }
  return text +
         "  esac\n}\nif [[ $funcstack[1] == _plastron ]]; then _plastron \"$@\"; else compdef _plastron plastron; fi\n";
}

// ---- fish ------------------------------------------------------------------------------------------------------

std::string fish_values(const Argument& argument) {
  switch (argument.accepts) {
    case Accepts::file: {
      std::string suffixes;
      for (const std::string& ending : argument.words)
        suffixes += fmt::format("{}__fish_complete_suffix .{}", suffixes.empty() ? "" : "; ", ending);
      return fmt::format(" -k -a '({})'", suffixes);
    }
    case Accepts::directory:
      return " -x -a '(__fish_complete_directories)'";
    case Accepts::setting:
    case Accepts::words:
      return fmt::format(" -x -a {}", in_quotes(fmt::format("{}", fmt::join(argument.words, " "))));
    case Accepts::nothing:
      return "";
    default:
      return " -x";
  }
}

std::string fish(const std::vector<Command>& commands) {
  std::string text = "# fish completion of plastron, made by `plastron completion fish`\ncomplete -c plastron -f\n";
  for (const Command& c : commands)
    text += fmt::format("complete -c plastron -n __fish_use_subcommand -a {} -d {}\n", c.name, in_quotes(c.meaning));
  text +=
      "complete -c plastron -n __fish_use_subcommand -l version -d 'Display program version information and exit'\n";
  for (const Command& c : commands) {
    const std::string begin = fmt::format("complete -c plastron -n '__fish_seen_subcommand_from {}'", c.name);
    for (const Argument& option : c.options) {
      text += begin;
      for (const std::string& name : option.names)
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      text += fmt::format("{}{} -d {}\n", option.accepts == Accepts::file ? " -r" : "", fish_values(option),
                          in_quotes(option.meaning));
    }
    for (const Argument& positional : c.positionals) {
      const std::string values = fish_values(positional);
      if (!values.empty()) text += begin + (values.starts_with(" -x") ? " -f" + values.substr(3) : values) + "\n";
    }
  }
  return text;
}

}  // namespace

ExitCode print_completion(const CLI::App& program, const std::string& shell) {
  const auto commands = command_list(program);
  if (is_first_rank())
    print_raw(stdout, shell == "bash" ? bash(commands) : shell == "zsh" ? zsh(commands) : fish(commands));
  return solved;
}

}  // namespace plastron::app
