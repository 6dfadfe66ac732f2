// A case file as a computation::Problem. This folder is the only reader of case files; the format is docs/case-file.md.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/config/mistakes.hpp>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace plastron::config {

struct Case {
  std::string title;
  geometry::Constants constants;
  computation::Problem problem;
  nlohmann::json effective;  ///< all settings, defaults included, in the shape of the case file
};

/// Throws CaseErrors.
Case read_case(const std::filesystem::path& path);
/// Mesh files are searched for relative to the folder of `file_name`. Throws CaseErrors.
Case parse_case(std::string text, std::string file_name);

}  // namespace plastron::config
