// The surfaces of the obstacles as triangles for ParaView, beside the shell's.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/obstacle/surface_mesh.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// The box that holds the deformed shell, and half of its diagonal more on every side (collective).
obstacle::Extent surroundings(const computation::Solution& solution);

struct DrawnObstacle {
  std::size_t number = 0;  ///< counted from 0 as in results.json
  obstacle::TriangleMesh surface;
};
/// The surfaces of all obstacles where they stand, as far as they are within `extent`. Obstacles that are one body for both faces are drawn
/// once.
std::vector<DrawnObstacle> drawn_obstacles(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent);

/// Triangles of all obstacles where they stand, as far as they are within `extent`; `obstacle` says which each belongs to.
std::string obstacle_surfaces_vtu(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent);

/// Adds the file, unless there are no obstacles; says whether it did (collective). Throws std::runtime_error.
bool add_obstacle_surfaces(const computation::Solution& solution, const std::filesystem::path& path,
                           AtomicFiles& files);

}  // namespace plastron::io
