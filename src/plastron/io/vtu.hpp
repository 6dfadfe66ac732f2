// The deformed surface with all fields for ParaView: one .vtu file of Lagrange quadrilaterals of the elements' degree.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// Adds a .vtu file, whose points are phi + displacement_scale u (collective). Each cell has its own points, equidistant in its parameters, because resultants jump between cells;
/// coordinates and values are rounded to single precision. Throws std::runtime_error.
void add_vtu(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files,
             double displacement_scale = 1);

/// A .vtu file of a time series, beside the .pvd file.
struct DataSet {
  double time = 0;
  std::string file_name;
  int part = 0;  ///< 0 the shell, 1 the obstacles
};
/// Adds a .pvd file that names them (collective). Throws std::runtime_error.
void add_pvd(const std::vector<DataSet>& sets, const std::filesystem::path& path, AtomicFiles& files);

/// Writes base_name.vtu and base_name.pvd alone and returns their names.
std::vector<std::string> write_vtu(const computation::Solution& solution, const std::filesystem::path& directory,
                                   const std::string& base_name, double displacement_scale = 1);

}  // namespace plastron::io
