// The source files of a computation. results.json describes them under "verification", so that `plastron
// verify` finds them again and detects changed ones.
#pragma once
#include <plastron/io/checksum.hpp>
#include <plastron/io/quantities.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

struct SourceFile {
  std::string name;  ///< name as written in the case, relative to the case's folder
  Checksum checksum;
};

struct CaseSource {
  std::filesystem::path path;  ///< path of the case file, absolute
  std::string text;            ///< its bytes, as edited by settings
  std::vector<SourceFile> files{};
  std::vector<std::string> settings{};  ///< settings that replaced keys of the file
};

/// Returns the source with the files by name and path; reads these files (throws std::runtime_error).
CaseSource case_source(const std::filesystem::path& case_file, std::string text,
                       const std::vector<std::pair<std::string, std::filesystem::path>>& files);

/// Returns {"bytes": ..., "sha256": ...}.
Json checksum_json(const Checksum& checksum);
/// Returns {"path": ..., "copy": ..., "set": [...], "bytes": ..., "sha256": ..., "files": [{"name": ..., "bytes": ...,
/// "sha256": ...}]}.
Json case_source_json(const CaseSource& source, const std::string& copy);

}  // namespace plastron::io
