// The surfaces of the obstacles as triangles, drawn beside the shell in ParaView and in report.html.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/obstacle/surface_mesh.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// Returns the box around the deformed shell, extended on every side by half of its diagonal (collective).
obstacle::Extent surroundings(const computation::Solution& solution);

struct DrawnObstacle {
  std::size_t number = 0;  ///< counted from 0 as in results.json
  obstacle::TriangleMesh surface;
};
/// Returns the surfaces of all obstacles at their positions, within `extent`. Obstacles that are one body for both
/// faces are drawn once.
std::vector<DrawnObstacle> drawn_obstacles(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent);

/// Returns triangles of all obstacles at their positions, within `extent`; `obstacle` is the number of each triangle's
/// obstacle.
std::string obstacle_surfaces_vtu(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent);

/// Adds the file if there are obstacles; returns whether it did (collective). Throws std::runtime_error.
bool add_obstacle_surfaces(const computation::Solution& solution, const std::filesystem::path& path,
                           AtomicFiles& files);

/// Returns the surface itself if it has at most `most` triangles. Otherwise vertices in the same box of a grid become
/// one (vertex clustering of Rossignac and Borrel), on the finest possible grid of 96, 48, 24 or 12 boxes along its
/// longest side. A box's vertex is the first of the surface's own vertices in it, so that drawn points are on the
/// surface.
obstacle::TriangleMesh thinned_surface(const obstacle::TriangleMesh& surface, std::size_t most);

}  // namespace plastron::io
