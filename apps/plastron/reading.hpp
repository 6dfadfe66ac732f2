// Reading of case files by all processes of a job. Each reads by itself; if one fails, all report it and end. The first
// process reads mesh files.
#pragma once
#include <plastron/config/case.hpp>
#include <plastron/examination/examine.hpp>

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::app {

/// The mistakes of a case file, in printed form.
struct RefusedCase : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the case with `settings` in place of some of its keys. Throws RefusedCase (collective).
config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings);
/// Searches in `folder` for the files that the case names.
config::Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Returns the findings of `examination`, which must not communicate: the first rank runs it and sends them to the
/// others (collective).
std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination);

}  // namespace plastron::app
