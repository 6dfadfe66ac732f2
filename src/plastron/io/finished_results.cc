#include <plastron/io/finished_results.hpp>

#include <plastron/io/bytes.hpp>
#include <plastron/io/results.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace plastron::io {

const std::string_view version = PLASTRON_VERSION;

namespace {

using Files = std::vector<std::pair<std::string, std::filesystem::path>>;

/// Whether the file has the checksum that an entry of results.json claims.
bool is_unchanged(const Json& entry, const Files& files) {
  const auto named = std::ranges::find(files, entry.at("name").get<std::string>(), &Files::value_type::first);
  if (named == files.end()) return false;
  try {
    return checksum_of_file(named->second).hash == entry.at("sha256");
  } catch (const std::runtime_error&) {  // there is no such file any more
    return false;
  }
}

}  // namespace

Json finished_results(const std::filesystem::path& folder, std::string_view case_text, const Files& files) {
  std::ifstream stream(folder / results_name, std::ios::binary);
  if (!stream) return nullptr;
  try {
    Json results = Json::parse(stream);
    const Json& source = results.at("verification").at("case");
    const auto is_same = [&](const Json& file) { return is_unchanged(file, files); };
    if (results.at("status") == "interrupted" || source.at("sha256") != checksum_of_text(case_text).hash)
      return nullptr;
    const auto& claimed = source.at("files").get_ref<const Json::array_t&>();
    return std::ranges::all_of(claimed, is_same) ? results : Json();
  } catch (const Json::exception&) {  // results.json is damaged
    return nullptr;
  }
}

}  // namespace plastron::io
