// The expectations of a wrong case file: the "# expect: " lines at its beginning.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace plastron::test {

inline std::vector<std::string> expectations(const std::filesystem::path& file) {
  const std::string mark = "# expect: ";
  std::vector<std::string> all;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line) && line.starts_with(mark);) all.push_back(line.substr(mark.size()));
  return all;
}

}  // namespace plastron::test
