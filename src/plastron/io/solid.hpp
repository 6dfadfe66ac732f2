// The deformed shell with its thickness for ParaView: solid.vtu, layers of hexahedra or wedges from the lower to the
// upper face.
#pragma once
#include <plastron/io/vtu.hpp>

namespace plastron::io {

inline constexpr std::string_view solid_name =
    "solid.vtu";  ///< file of the last instant; other instants have solid-0001.vtu and so on

/// Adds a .vtu file of points phi + z a_3 + u + z r. Each cell of the mesh is divided k x k times, and into layers
/// through the thickness. It has its own points. They have displacement, z, the stresses at z and, with obstacles,
/// contact and eta of the face that contains them (collective). `choice` gives precision and names of units. Throws
/// std::runtime_error.
void add_solid(const computation::Solution& solution, int layers, const std::filesystem::path& path, AtomicFiles& files,
               const VtuChoice& choice = {});

}  // namespace plastron::io
