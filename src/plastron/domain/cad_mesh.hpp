// Meshes of CAD files, made by the program plastron-cad in a process of its own: what damages Open CASCADE or Gmsh, or
// makes them search without end, ends that process.
#pragma once
#include <plastron/domain/domain.hpp>

#include <string>

namespace plastron::domain {

/// Meshes a CAD file. Starts plastron-cad, which is where the environment variable PLASTRON_CAD says, beside this program,
/// or on the PATH; it ends after a minute.
FrozenMesh frozen_mesh(const MeshFile& file);

}  // namespace plastron::domain
