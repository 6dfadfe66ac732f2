// Least-squares fit of heights over a plane by a polynomial of two variables.
#pragma once
#include <Eigen/Core>

#include <span>

namespace plastron::topology {

/// The plane through `origin` with orthonormal axes; axes.col(2) is its normal.
struct FitPlane {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;
  double scale = 1;  ///< length of one unit of the plane's coordinates [m]

  /// Coordinates in the plane and height, over the scale.
  Eigen::Vector3d local(const Eigen::Vector3d& point) const { return axes.transpose() * (point - origin) / scale; }
};

class HeightFit {
 public:
  /// Fits points in local coordinates. Precondition: at least coefficient_count(degree) points.
  HeightFit(std::span<const Eigen::Vector3d> points, int degree);

  static int coefficient_count(int degree) { return (degree + 1) * (degree + 2) / 2; }

  /// Whether the points determine the polynomial: on three parallel lines they do not determine a cubic one.
  bool is_determined() const { return is_determined_; }
  double height(double s, double t) const;
  /// The normal (-h_s, -h_t, 1), not normalised.
  Eigen::Vector3d normal(double s, double t) const;

 private:
  int degree_;
  bool is_determined_ = false;
  Eigen::VectorXd coefficients_;
};

}  // namespace plastron::topology
