// A case file as a computation::Problem. This folder is the only reader of case files; the format is docs/case-file.md.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/config/input_file.hpp>
#include <plastron/config/mistakes.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace plastron::config {

struct Case {
  std::string title;
  geometry::Constants constants;
  computation::Problem problem;
  bool wants_report = true;        ///< [output] report
  nlohmann::json effective;        ///< all settings, defaults included, in the shape of the case file
  std::string text{};              ///< of the case file, byte for byte
  std::vector<InputFile> files{};  ///< that the case names: meshes, rasters, surfaces
};

/// Throws CaseErrors.
Case read_case(const std::filesystem::path& path);
/// The files that the case names are searched for in `folder`. Throws CaseErrors.
Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder);
/// The files that the case names are searched for in the folder of `file_name`. Throws CaseErrors.
Case parse_case(std::string text, std::string file_name);

}  // namespace plastron::config
