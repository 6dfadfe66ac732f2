#include <plastron/io/case_source.hpp>

#include <algorithm>

namespace plastron::io {

CaseSource case_source(const std::filesystem::path& case_file, std::string text,
                       const std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  CaseSource source{.path = std::filesystem::absolute(case_file).lexically_normal(), .text = std::move(text)};
  for (const auto& [name, path] : files)
    if (std::ranges::find(source.files, name, &SourceFile::name) == source.files.end())
      source.files.push_back({.name = name, .checksum = checksum_of_file(path)});
  return source;
}

Json checksum_json(const Checksum& checksum) { return {{"bytes", checksum.bytes}, {"sha256", checksum.hash}}; }

Json case_source_json(const CaseSource& source, const std::string& copy) {
  Json json{{"path", source.path.string()}, {"copy", copy}, {"set", source.settings}};
  json.update(checksum_json(checksum_of_text(source.text)));
  json["files"] = Json::array();
  for (const SourceFile& file : source.files) {
    Json entry{{"name", file.name}};
    entry.update(checksum_json(file.checksum));
    json["files"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace plastron::io
