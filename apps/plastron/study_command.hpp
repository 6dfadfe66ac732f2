// The arguments of `plastron study`: one table of kinds, and options for some of them.
#pragma once
#include <research/names/study_names.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::app {

struct StudyCommand {
  std::string kind;
  std::filesystem::path case_file;
  std::filesystem::path output;
  std::vector<std::string> settings{};  ///< settings that replace keys of the case file
  bool quiet = false;                   ///< print errors only
  int threads = 0;                      ///< for each process; 0: as many as the amount of work justifies
  bool json_log = false;                ///< events on standard error
  study::StudyOptions options{};
};

CLI::App* add_study(CLI::App& program, StudyCommand& command);

}  // namespace plastron::app
