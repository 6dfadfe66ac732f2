// Case files as all processes of a job read them: each by itself, and if one cannot, all say so and end. Mesh files are read by the first.
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

/// What is wrong with a case file, as it is printed.
struct RefusedCase : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The case with `settings` in place of some of its keys. Throws RefusedCase (collective).
config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings);
/// The files that the case names are searched for in `folder`.
config::Case read_case(const std::filesystem::path& path, const std::filesystem::path& folder);

/// What `examination` finds, which communicates with nobody: the first rank does it and tells the others (collective).
std::vector<examination::Finding> examine_together(
    const std::function<std::vector<examination::Finding>()>& examination);

}  // namespace plastron::app
