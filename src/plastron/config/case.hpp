// Reads a case file as a problem::Problem. Only this folder reads case files; the format is docs/case-file.md.
#pragma once
#include <plastron/config/mistakes.hpp>
#include <plastron/problem/problem.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace plastron::config {

struct Case {
  std::string title;
  geometry::Constants constants;
  problem::Problem problem;
  bool wants_report = true;  ///< [output] report
  nlohmann::json effective;  ///< all settings, including defaults, in the form of the case file
  std::string text{};        ///< text of the case file, byte for byte; after `settings` the edited text
  /// Files that the case names: meshes, rasters, surfaces. Each has its name as written in the case, and its path.
  std::vector<std::pair<std::string, std::filesystem::path>> files{};
};

/// Reads a case. `settings` replace keys of the file, for example "shell.thickness=0.02" (overrides.hpp). Throws
/// CaseErrors.
Case read_case(const std::filesystem::path& path, std::span<const std::string> settings = {});
/// Searches in `folder` for the files that the case names. Throws CaseErrors.
Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder);
/// Reads a case from a text instead of a file, with `settings` likewise. Searches in the folder of `file_name` for the files
/// that the case names. Throws CaseErrors.
Case parse_case(std::string text, std::string file_name, std::span<const std::string> settings = {});

}  // namespace plastron::config
