// The readers of an obstacle's shapes, one for each key of [[obstacle]] that names one.
#pragma once
#include <plastron/config/table.hpp>
#include <plastron/obstacle/obstacle.hpp>

#include <optional>

namespace plastron::config {

/// Returns the shape that an [[obstacle]] names. Reports mistakes, also if it names none or two.
std::optional<obstacle::Shape> read_shape(Table& obstacle);

/// Returns the unit vector along the three numbers of a key; reports the zero vector.
std::optional<Eigen::Vector3d> read_direction(Table& table, const std::string& name);
/// Reads `rotate`, then `translate`.
std::optional<obstacle::Motion> read_motion(Table& table);

}  // namespace plastron::config
