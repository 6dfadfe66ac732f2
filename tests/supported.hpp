// Nodes with prescribed coordinates.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>

#include <cstddef>

namespace plastron::test {

/// Whether a support, or a constraint of the node, prescribes one of its coordinates.
inline bool is_supported(const assembly::NodalCoordinates& coordinates, std::size_t node) {
  for (int k = 0; k < coordinates.width; ++k)
    if (coordinates.is_prescribed(node, k)) return true;
  return false;
}

}  // namespace plastron::test
