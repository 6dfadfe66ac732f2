// The commands that compute nothing: `plastron` runs them itself, without the solver. Each returns an exit code.
#pragma once
#include "exit_codes.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

/// Prints the manual for a word; an overview without a word.
ExitCode explain(const std::string& word);
/// Returns the words that explain() knows in full, for completion.
std::vector<std::string> explained_words();

/// Writes the template as NAME.toml or NAME/case.toml, or lists the templates.
ExitCode new_case(const std::filesystem::path& name, const std::string& template_name, bool is_listing);
std::vector<std::string> template_names();

/// Prints the schema of the "case" file or of "results".json.
ExitCode print_schema(const std::string& of);

/// Prints the completion for "bash", "zsh" or "fish".
ExitCode print_completion(const CLI::App& program, const std::string& shell);
ExitCode print_manual_page(const CLI::App& program);

/// Writes plot-*.svg of the results in a directory into this directory.
ExitCode plot(const std::filesystem::path& directory);

}  // namespace plastron::app
