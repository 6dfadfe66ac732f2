// The triangles of a file as a surface: those that occur twice or have no area are removed, all are turned alike, and what is
// no surface is refused.
#pragma once
#include <plastron/facets/triangles.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace plastron::facets {

/// The sides of a mesh, each with its triangles.
struct Sides {
  std::vector<geometry::TriangleSide> all;
  std::vector<std::array<std::size_t, 2>> ranges{};  ///< of `all`, one for each side

  explicit Sides(const TriangleMesh& mesh);
};

/// Removes triangles whose corners are those of another one. Returns their number.
std::size_t remove_repeated(TriangleMesh& mesh);

/// Removes triangles without area: each is given to its neighbour on its longest side. Returns their number. Throws FileError
/// with `name` in front if that is no surface.
std::size_t remove_flat(TriangleMesh& mesh, const std::string& name);

/// Throws FileError if more than two triangles meet at a side.
void check_sides(const TriangleMesh& mesh, const Sides& sides, const std::string& name);

/// Turns triangles so that neighbours are turned alike, each part as most of its area is in the file. Returns the number
/// of turned triangles. Throws FileError for a surface with one side only.
std::size_t turn_alike(TriangleMesh& mesh, const Sides& sides, const std::string& name);

}  // namespace plastron::facets
