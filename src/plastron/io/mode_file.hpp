// NAME.mode: the shape of a mode on its mesh, for [[imperfection]] (docs/results.md describes the bytes).
//
// A header, then a record for each cell: at each node its place in Omega, its place in space and the shape (u, r). No order of
// cells or ranks has a meaning.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/fem/shape_field.hpp>
#include <plastron/io/atomic_file.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

struct ModeHeader {
  std::array<char, 8> magic{'P', 'L', 'A', 'S', 'M', 'O', 'D', 'E'};
  std::uint32_t version = 1;
  std::uint32_t corners = 4;  ///< corners of a cell
  std::uint32_t degree = 1;
  std::uint32_t patches = 0;  ///< cells of the mesh in space; 0 if the mesh lies in a plane domain
  std::int64_t cells = 0;
};
static_assert(sizeof(ModeHeader) == 32);

/// A node of a cell: x, y (an address on a mesh in space), phi, u, r.
using ModeRecord = std::array<double, 11>;

/// Adds a file for each mode that the case asks for. Returns their names (collective). Throws std::runtime_error.
std::vector<std::string> add_modes(const computation::Solution& solution, const std::filesystem::path& directory,
                                   AtomicFiles& files);

/// Whether add_modes() gives files such names: buckling_1.mode, vibration_12.mode.
bool is_mode_name(std::string_view name);

/// Reads a mode, multiplied by `amplitude`, for a mesh in space of so many cells or for a plane domain (0). Throws
/// UnusableResults: no such file, another format or version, incomplete, another mesh in space, or values that are not finite.
std::shared_ptr<const fem::ShapeField> read_mode(const std::filesystem::path& path, double amplitude,
                                                 std::size_t patches);

}  // namespace plastron::io
