// Reads back what io/vtu.cc writes: an XML file of pieces whose arrays are zlib-compressed in base64.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace plastron::io {

struct VtuArray {
  int components = 1;
  std::string unit;
  std::vector<double> values;
};

/// All pieces one after the other.
struct VtuFile {
  std::size_t points = 0, cells = 0;
  int pieces = 0;
  std::map<std::string, VtuArray> arrays;  ///< of the points, with their coordinates as "points"
  std::vector<int> connectivity;           ///< of all cells, point numbers of the whole file
  std::vector<int> offsets;                ///< one past the end of each cell in `connectivity`
  std::vector<int> types;
};

/// Throws std::runtime_error.
VtuFile read_vtu(const std::filesystem::path& path);

}  // namespace plastron::io
