#include <plastron/io/finished_results.hpp>

#include <plastron/io/bytes.hpp>
#include <plastron/io/results.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace plastron::io {

namespace {

/// Whether the file has the checksum that an entry of results.json claims.
bool is_unchanged(const Json& entry, const std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  const auto named = std::ranges::find(files, entry.value("name", ""), [](const auto& file) { return file.first; });
  if (named == files.end()) return false;
  try {
    return checksum_of_file(named->second).hash == entry.value("sha256", "");
  } catch (const std::runtime_error&) {  // there is no such file any more
    return false;
  }
}

}  // namespace

Json finished_results(const std::filesystem::path& folder, std::string_view case_text,
                      const std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  std::ifstream stream(folder / results_name, std::ios::binary);
  if (!stream) return nullptr;
  Json results = Json::parse(stream, nullptr, false);
  const Json::json_pointer hash("/verification/case/sha256"), named("/verification/case/files");
  if (!results.is_object() || !results.contains(hash) || !results.contains(named)) return nullptr;
  const bool is_same = results[hash] == checksum_of_text(case_text).hash &&
                       results.value("status", "") != "interrupted" &&
                       std::ranges::all_of(results[named], [&](const Json& file) { return is_unchanged(file, files); });
  return is_same ? results : Json();
}

}  // namespace plastron::io
