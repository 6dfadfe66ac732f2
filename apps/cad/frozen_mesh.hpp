// The mesh of a part as a file of Gmsh, with the true normals of its faces. Any reader of .msh takes it.
#pragma once
#include "sampling.hpp"
#include "selection.hpp"

#include <string>
#include <vector>

namespace plastron::cad {

/// Writes MSH 4.1 as text, lengths divided by `unit` [mm]. `notes`: sentences for the user.
void write_mesh(const std::string& path, const SampledMesh& mesh, const PartNames& names, double unit,
                const std::vector<std::string>& notes);

}  // namespace plastron::cad
