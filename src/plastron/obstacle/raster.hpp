// Heights on a grid of equal cells, interpolated by the natural bicubic spline, which is twice continuously
// differentiable.
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <string>

namespace plastron::obstacle {

/// h(x, y) with its derivatives.
struct HeightJet {
  double value = 0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

class Raster {
 public:
  /// heights(i, j) is at from + cell (i, j); at least 2 x 2 heights. Throws ObstacleError for fewer or non-finite
  /// heights.
  Raster(const Eigen::MatrixXd& heights, const Eigen::Vector2d& from, double cell);

  bool covers(const Eigen::Vector2d& p) const { return (p.array() >= from_.array() && p.array() <= to_.array()).all(); }
  /// Precondition: covers(p).
  HeightJet operator()(const Eigen::Vector2d& p) const;

  const Eigen::Vector2d& from() const { return from_; }
  const Eigen::Vector2d& to() const { return to_; }
  double cell() const { return cell_; }

 private:
  Eigen::MatrixXd coefficients_;  // coefficients of cubic B-splines, with one more row and column on each side
  Eigen::Vector2d from_, to_;
  double cell_;
};

inline constexpr std::size_t most_raster_points = 4'000'000;

/// Reads an ESRI ASCII grid. Its lines are ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize and
/// optionally NODATA_value. The heights follow, the row of the greatest y first. A corner is half a cell outside of
/// the first height. Throws ObstacleError: no such file, no such format, too many heights, heights missing or not
/// finite.
Raster read_raster(const std::string& path);

}  // namespace plastron::obstacle
