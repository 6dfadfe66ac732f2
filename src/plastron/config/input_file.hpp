// A file that a case names: a mesh, a raster, a surface.
#pragma once
#include <filesystem>
#include <string>

namespace plastron::config {

struct InputFile {
  std::string name;  ///< name as written in the case
  std::filesystem::path path;
};

}  // namespace plastron::config
