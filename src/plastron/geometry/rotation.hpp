// Rotations as matrices and as vectors: axis times angle.
#pragma once
#include <Eigen/Core>

namespace plastron::geometry {

/// Returns the matrix of the product v x.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// Returns axis times angle of a rotation, with an angle of at most pi [rad].
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& turn);

/// Returns the vector of a rotation that is nearest to another one; it can be longer than pi [rad].
Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& turn, const Eigen::Vector3d& near);

/// Returns the rotation of a vector: axis times angle [rad].
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector);

}  // namespace plastron::geometry
