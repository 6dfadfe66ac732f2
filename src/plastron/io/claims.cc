#include <plastron/algebra/agreement.hpp>
#include <plastron/io/claims.hpp>

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <sstream>

namespace plastron::io {

namespace {

/// Limit of the size of results.json. A larger file would only fill the memory.
constexpr std::uintmax_t largest_results = std::uintmax_t{64} << 20;

/// Reads regular files only: a pipe or a device has no end.
std::string text_of_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw UnusableResults(fmt::format("{}: there is no {} here; give the directory that plastron run wrote",
                                      path.parent_path().string(), path.filename().string()));
  if (std::filesystem::file_size(path, error) > largest_results)
    throw UnusableResults(fmt::format("{}: the file is too large for results of plastron run", path.string()));
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad() || text.empty()) throw UnusableResults(fmt::format("{}: the file cannot be read", path.string()));
  return text;
}

std::string text_of_results(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path.parent_path(), error))
    throw UnusableResults(fmt::format("{}: there is no such directory", path.parent_path().string()));
  return text_of_file(path);
}

Json json_of(const std::string& text, const std::filesystem::path& path) {
  // Copies and destructors of a JSON value are recursive in its depth.
  constexpr int deepest = 100;
  const auto is_shallow = [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > deepest)
      throw UnusableResults(
          fmt::format("{}: the JSON is nested too deeply for results of plastron run", path.string()));
    return true;
  };
  try {
    return Json::parse(text, is_shallow);
  } catch (const Json::exception& error) {
    throw UnusableResults(fmt::format("{}: the file is not JSON, or not complete: {}", path.string(), error.what()));
  }
}

/// Reads entries of results.json and reports a missing one.
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
  /// Returns the name of a file beside results.json.
  std::string file_name(const char* name) const {
    std::string file = text(name);
    if (file.empty() || std::filesystem::path(file).filename() != file) refuse(name);
    return file;
  }
  Checksum checksum() const {
    const Entries bytes = at("bytes");
    if (!bytes.json_.is_number_unsigned()) refuse("bytes");
    return {bytes.json_.get<std::uintmax_t>(), text("sha256")};
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
    throw UnusableResults(fmt::format(
        "{}.{} is missing, or does not have the form that plastron run writes: an earlier version wrote these "
        "results, or the case was not run from a file; run the case again",
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

/// Returns name -> hash, from the lines of SHA256SUMS.
std::map<std::string, std::string> stored_hashes(const std::filesystem::path& path) {
  constexpr std::size_t digits = 64;
  std::map<std::string, std::string> hashes;
  std::istringstream lines(text_of_file(path));
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.size() > digits + 2 ? line.substr(digits + 2) : "";
    if (name.empty() || line.substr(digits, 2) != "  " || std::filesystem::path(name).filename() != name)
      throw UnusableResults(fmt::format("{}: line {} is not a checksum", path.string(), hashes.size() + 1));
    hashes[name] = line.substr(0, digits);
  }
  return hashes;
}

std::string difference(const std::filesystem::path& path, const std::string& stored) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return fmt::format("{} is missing", path.filename().string());
  try {
    if (checksum_of_file(path).hash == stored) return {};
    return fmt::format("{} is not the file that plastron run wrote: its SHA-256 differs", path.filename().string());
  } catch (const std::runtime_error& unreadable) {
    return unreadable.what();
  }
}

/// Returns all names that results.json gives its files.
std::vector<std::string> names_of_files(const Json& results) {
  std::vector<std::string> names{std::string(results_name)};
  if (const auto list = results.find("files"); list != results.end() && list->is_array())
    for (const Json& name : *list)
      if (name.is_string() && name != Json(checksums_name)) names.push_back(name.get<std::string>());
  return names;
}

}  // namespace

StoredChecksums compare_checksums(const std::filesystem::path& directory, const Json& results, MPI_Comm comm) {
  return algebra::in_agreement<UnusableResults>(comm, [&] {
    std::error_code error;
    if (!std::filesystem::exists(directory / checksums_name, error))
      throw UnusableResults(
          fmt::format("{}: there is no {}, so changes of the files cannot be detected; run the case again",
                      directory.string(), checksums_name));
    const auto hashes = stored_hashes(directory / checksums_name);
    StoredChecksums found{.files = hashes.size()};
    for (const auto& [name, stored] : hashes)
      if (std::string words = difference(directory / name, stored); !words.empty())
        found.failures.push_back(std::move(words));
    for (const std::string& name : names_of_files(results))
      if (!hashes.contains(name))
        found.failures.push_back(fmt::format("{} has no checksum in {}", name, checksums_name));
    return found;
  });
}

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
