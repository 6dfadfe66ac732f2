#include <plastron/algebra/agreement.hpp>
#include <plastron/io/claims.hpp>

#include <fmt/format.h>

#include <fstream>

namespace plastron::io {

namespace {

/// No results.json is larger; what is would only fill the memory.
constexpr std::uintmax_t largest_results = std::uintmax_t{64} << 20;

std::string text_of_results(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path.parent_path(), error))
    throw UnusableResults(fmt::format("{}: there is no such directory", path.parent_path().string()));
  if (!std::filesystem::is_regular_file(path, error))
    throw UnusableResults(
        fmt::format("{}: there are no results here: no results.json; name the directory that "
                    "plastron run wrote to",
                    path.parent_path().string()));
  if (std::filesystem::file_size(path, error) > largest_results)
    throw UnusableResults(fmt::format("{}: the file is larger than any results are", path.string()));
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad() || text.empty()) throw UnusableResults(fmt::format("{}: the file cannot be read", path.string()));
  return text;
}

Json json_of(const std::string& text, const std::filesystem::path& path) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw UnusableResults(fmt::format("{}: this is no JSON, or not all of it: {}", path.string(), error.what()));
  }
}

/// Reads entries of results.json and says which is not there.
class Entries {
 public:
  Entries(const Json& json, std::string where) : json_(json), where_(std::move(where)) {}

  Entries at(const char* name) const {
    if (!json_.is_object() || !json_.contains(name) || json_[name].is_null()) refuse(name);
    return {json_[name], where_ + "." + name};
  }
  bool has(const char* name) const { return json_.is_object() && json_.contains(name) && !json_[name].is_null(); }
  std::string text(const char* name) const {
    const Entries entry = at(name);
    if (!entry.json_.is_string()) refuse(name);
    return entry.json_.get<std::string>();
  }
  /// The name of a file beside results.json.
  std::string file_name(const char* name) const {
    std::string file = text(name);
    if (file.empty() || std::filesystem::path(file).filename() != file) refuse(name);
    return file;
  }
  Checksum checksum() const {
    const Entries bytes = at("bytes");
    if (!bytes.json_.is_number_unsigned()) refuse("bytes");
    return {bytes.json_.get<std::uintmax_t>(), text("hash")};
  }
  std::vector<Entries> list(const char* name) const {
    const Entries entry = at(name);
    if (!entry.json_.is_array()) refuse(name);
    std::vector<Entries> all;
    for (const Json& item : entry.json_) all.emplace_back(item, entry.where_);
    return all;
  }

 private:
  [[noreturn]] void refuse(const char* name) const {
    throw UnusableResults(
        fmt::format("{}.{} is not there, or not as plastron run writes it: an earlier version wrote these results, or "
                    "the case was not run from a file; run the case again",
                    where_, name));
  }
  const Json& json_;
  std::string where_;
};

std::string change_of(const std::string& what, const std::filesystem::path& path, const Checksum& was) {
  try {
    const Checksum is = checksum_of_file(path);
    if (is == was) return {};
    return fmt::format("{} has changed since the case was run: {} has {} bytes ({}), it had {} ({})\n", what,
                       path.string(), is.bytes, is.hash, was.bytes, was.hash);
  } catch (const std::runtime_error& error) {
    return fmt::format("{} cannot be read: {}\n", what, error.what());
  }
}

}  // namespace

Claims read_claims(const std::filesystem::path& directory, MPI_Comm comm) {
  return algebra::in_agreement<UnusableResults>(comm, [&] {
    const std::filesystem::path path = directory / results_name;
    Claims claims{.results = json_of(text_of_results(path), path)};
    const Entries all(claims.results, path.string());
    claims.status = all.text("status");
    const Entries verification = all.at("verification"), source = verification.at("case");
    if (verification.has("solution")) claims.solution = directory / verification.file_name("solution");
    claims.case_copy = directory / source.file_name("copy");
    claims.case_checksum = source.checksum();
    claims.case_folder = std::filesystem::path(source.text("path")).parent_path();
    for (const Entries& file : source.list("files"))
      claims.files.push_back({.name = file.text("name"), .checksum = file.checksum()});
    return claims;
  });
}

void check_sources(const Claims& claims, const std::filesystem::path& folder, MPI_Comm comm) {
  algebra::in_agreement<UnusableResults>(comm, [&] {
    std::string changes = change_of("the copy of the case", claims.case_copy, claims.case_checksum);
    for (const SourceFile& file : claims.files)
      changes +=
          change_of(fmt::format("the file \"{}\" that the case names", file.name), folder / file.name, file.checksum);
    if (!changes.empty()) changes.pop_back();
    if (!changes.empty()) throw UnusableResults(changes);
  });
}

}  // namespace plastron::io
