// Results that an earlier run of the same case has left in a folder: a sweep that goes on takes them.
#pragma once
#include <plastron/io/quantities.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::io {

/// Returns results.json of a folder if its run was not interrupted, and if its case had this text and files with the same contents.
/// Otherwise returns null.
Json finished_results(const std::filesystem::path& folder, std::string_view case_text,
                      const std::vector<std::pair<std::string, std::filesystem::path>>& files);

}  // namespace plastron::io
