// From which files a computation was made: what results.json tells of them under "verification", so that `plastron
// verify` finds them again and notices those that have changed.
#pragma once
#include <plastron/io/checksum.hpp>
#include <plastron/io/quantities.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

struct SourceFile {
  std::string name;  ///< as the case has it, relative to the case's folder
  Checksum checksum;
};

struct CaseSource {
  std::filesystem::path path;  ///< of the case file, absolute
  std::string text;            ///< its bytes, as settings have edited them
  std::vector<SourceFile> files{};
  std::vector<std::string> settings{};  ///< that took the place of keys of the file
};

/// Files by name and path; reads those (throws std::runtime_error).
CaseSource case_source(const std::filesystem::path& case_file, std::string text,
                       const std::vector<std::pair<std::string, std::filesystem::path>>& files);

/// {"bytes": ..., "sha256": ...}
Json checksum_json(const Checksum& checksum);
/// {"path": ..., "copy": ..., "set": [...], "bytes": ..., "sha256": ..., "files": [{"name": ..., "bytes": ..., "sha256": ...}]}
Json case_source_json(const CaseSource& source, const std::string& copy);

}  // namespace plastron::io
