// The deformed surface with all fields for ParaView: one .vtu file of Lagrange quadrilaterals of the elements' degree.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// Adds base_name.vtu, whose points are phi + displacement_scale u, and base_name.pvd, which names it (collective). Each cell has its own points, equidistant in its parameters, because resultants jump between cells;
/// coordinates and values are rounded to single precision. Returns the names of the files. Throws std::runtime_error.
std::vector<std::string> add_vtu(const computation::Solution& solution, const std::filesystem::path& directory,
                                 const std::string& base_name, AtomicFiles& files, double displacement_scale = 1);
/// Writes them alone.
std::vector<std::string> write_vtu(const computation::Solution& solution, const std::filesystem::path& directory,
                                   const std::string& base_name, double displacement_scale = 1);

}  // namespace plastron::io
