// The readers of an obstacle's shapes, one for each key of [[obstacle]] that names one.
#pragma once
#include <plastron/config/table.hpp>
#include <plastron/obstacle/obstacle.hpp>

#include <optional>

namespace plastron::config {

/// The shape that an [[obstacle]] names. Reports what is wrong, none or two of them among it.
std::optional<obstacle::Shape> read_shape(Table& obstacle);

/// The unit vector along the three numbers of a key; the zero vector is reported.
std::optional<Eigen::Vector3d> read_direction(Table& table, const std::string& name);
/// `rotate`, then `translate`.
std::optional<obstacle::Motion> read_motion(Table& table);

}  // namespace plastron::config
