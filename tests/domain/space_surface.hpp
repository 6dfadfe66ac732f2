// Surfaces of meshes in space that tests make, with names for parts of their borders.
#pragma once
#include "topology/space_meshes.hpp"

#include <plastron/domain/surface_mesh.hpp>

#include <functional>
#include <memory>
#include <utility>

namespace plastron::domain::space_meshes {

/// A boundary's name, and whether a point of a border belongs to it.
using NamedBorder = std::pair<std::string, std::function<bool(const Vector3d&)>>;

/// The surface of a mesh. A border edge has a name if both of its ends belong to it.
inline FileSurface surface_of(topology::SpaceMesh mesh, const std::vector<NamedBorder>& borders = {},
                              const topology::SurfaceOptions& options = {}) {
  FileSurface surface{.topology = topology::surface_topology(std::move(mesh), options), .regions = {""}};
  for (const auto& [name, belongs] : borders) {
    const auto boundary = static_cast<int>(surface.boundaries.size());
    surface.boundaries.push_back(name);
    for (std::size_t e = 0; e < surface.topology.edges.size(); ++e) {
      const topology::SurfaceEdge& edge = surface.topology.edges[e];
      const auto at = [&](int k) { return surface.topology.mesh.nodes[static_cast<std::size_t>(edge.ends[k])]; };
      if (edge.kind == topology::EdgeKind::border && belongs(at(0)) && belongs(at(1)))
        surface.named_edges.push_back({.edge = e, .boundary = boundary});
    }
  }
  return surface;
}

/// The mesh as a domain that needs no file.
inline MeshFile domain_of(const FileSurface& surface) {
  return {.path = "",
          .in_space = SpaceReading{},
          .mesh = std::make_shared<const mesh::CoarseMesh>(surface_mesh(surface, surface.topology.mesh.shape))};
}

}  // namespace plastron::domain::space_meshes
