#include "command_list.hpp"

#include "command_line.hpp"

#include <plastron/config/schema.hpp>
#include <research/names/study_names.hpp>

#include <algorithm>

namespace plastron::app {

namespace {

/// Returns "shell.thickness=" and so on: the keys with one value in the file.
std::vector<std::string> settable_keys() {
  using config::Kind;
  std::vector<std::string> keys;
  for (const config::Section& section : config::sections())
    for (const config::Key& key : section.keys) {
      const bool is_section = key.kind == Kind::table || key.kind == Kind::tables || key.kind == Kind::free_table;
      if (!is_section) keys.push_back((section.path.empty() ? "" : section.path + ".") + key.name + "=");
    }
  return keys;
}

std::vector<std::string> kinds_of_study() {
  std::vector<std::string> names;
  for (const study::KindName& kind : study::kind_names()) names.emplace_back(kind.name);
  return names;
}

void describe_values(const CLI::Option& option, Argument& argument) {
  const std::string& name = option.get_single_name();
  const auto offer = [&](std::vector<std::string> words, Accepts kind = Accepts::words) {
    argument.accepts = kind;
    argument.words = std::move(words);
  };
  if (option.get_items_expected_max() == 0)
    argument.accepts = Accepts::nothing;
  else if (name == "CASE")
    offer({"toml"}, Accepts::file);
  else if (name == "MESH")
    offer({"msh", "inp", "stl", "obj", "ply"}, Accepts::file);
  else if (name == "page")
    offer({"html"}, Accepts::file);
  else if (name == "DIR" || name == "NAME" || name == "output" || name == "files")
    argument.accepts = Accepts::directory;
  else if (name == "KIND")
    offer(kinds_of_study());
  else if (name == "WORD")
    offer(explained_words());
  else if (name == "OF")
    offer({"case", "results"});
  else if (name == "SHELL")
    offer({"bash", "zsh", "fish"});
  else if (name == "from")
    offer(example_names());
  else if (name == "set")
    offer(settable_keys(), Accepts::setting);
  else
    argument.accepts = Accepts::number;
}

Argument argument_of(const CLI::Option& option) {
  Argument argument{.meaning = option.get_description(), .is_required = option.get_required()};
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  if (option.get_positional()) argument.names = {option.get_name()};
  describe_values(option, argument);
  if (argument.accepts != Accepts::nothing) argument.fallback = option.get_default_str();
  return argument;
}

}  // namespace

std::vector<Command> command_list(const CLI::App& program) {
  std::vector<Command> commands;
  for (const CLI::App* app : program.get_subcommands([](const CLI::App*) { return true; })) {
    Command command{.name = app->get_name(), .meaning = app->get_description(), .footer = app->get_footer()};
    for (const CLI::Option* option : app->get_options())
      if (!option->get_group().empty())
        (option->get_positional() ? command.positionals : command.options).push_back(argument_of(*option));
    commands.push_back(std::move(command));
  }
  return commands;
}

}  // namespace plastron::app
