// The deformed shell for ParaView: solution.vtu, the surface with all fields in Lagrange quadrilaterals or triangles of
// the elements' degree, and solid.vtu, the shell with its thickness in layers of hexahedra or wedges.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/vtu_piece.hpp>
#include <plastron/problem/unit_names.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// Content and precision of a .vtu file.
struct VtuChoice {
  double displacement_scale = 1;  ///< points are phi + displacement_scale u
  std::vector<double> heights{};  ///< z / e of further stresses, see fields_of()
  bool is_double = false;         ///< coordinates and values in double precision; else rounded to single
  problem::UnitNames units{};     ///< names beside the arrays
};

/// Returns the cells of this rank with all fields. Each cell has its own points, equidistant in its parameters, because
/// resultants jump between cells.
GridPiece surface_piece(const computation::Solution& solution, const VtuChoice& choice = {});

/// Adds a .vtu file of the pieces of all ranks (collective). Throws std::runtime_error.
void add_vtu(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files,
             const VtuChoice& choice = {});

/// A .vtu file of a time series, beside the .pvd file.
struct DataSet {
  double time = 0;
  std::string file_name;
  int part = 0;  ///< 0 the shell, 1 the obstacles
};
/// Adds a .pvd file with the names of the data sets (collective). Throws std::runtime_error.
void add_pvd(const std::vector<DataSet>& sets, const std::filesystem::path& path, AtomicFiles& files);

/// The file of the last instant; other instants have solid-0001.vtu and so on.
inline constexpr std::string_view solid_name = "solid.vtu";

/// Adds a .vtu file of layers from the lower to the upper face. Each cell of the mesh is divided k x k times, and into
/// layers through the thickness. It has its own points phi + z a_3 + u + z r, with displacement, z, the stresses at z
/// and, with obstacles, contact and eta of the face that contains them (collective). `choice` gives precision and names
/// of units. Throws std::runtime_error.
void add_solid(const computation::Solution& solution, int layers, const std::filesystem::path& path, AtomicFiles& files,
               const VtuChoice& choice = {});

}  // namespace plastron::io
