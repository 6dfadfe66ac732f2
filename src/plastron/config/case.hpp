// A case file as a computation::Problem. This folder is the only reader of case files; the format is docs/case-file.md.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/config/input_file.hpp>
#include <plastron/config/mistakes.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace plastron::config {

struct Case {
  std::string title;
  geometry::Constants constants;
  computation::Problem problem;
  bool wants_report = true;        ///< [output] report
  nlohmann::json effective;        ///< all settings, defaults included, in the shape of the case file
  std::string text{};              ///< of the case file, byte for byte; with settings as those have edited it
  std::vector<InputFile> files{};  ///< that the case names: meshes, rasters, surfaces
};

/// `settings` take the place of keys of the file, "shell.thickness=0.02" each (overrides.hpp). Throws CaseErrors.
Case read_case(const std::filesystem::path& path, std::span<const std::string> settings = {});
/// The files that the case names are searched for in `folder`. Throws CaseErrors.
Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder);
/// The files that the case names are searched for in the folder of `file_name`. Throws CaseErrors.
Case parse_case(std::string text, std::string file_name);

}  // namespace plastron::config
