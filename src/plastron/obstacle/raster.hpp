// Heights on a grid of equal cells, made smooth by the natural bicubic spline through them: twice continuously differentiable.
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
  /// heights(i, j) stands at from + cell (i, j); at least 2 x 2 of them. Throws ObstacleError for fewer or heights that are not finite.
  Raster(const Eigen::MatrixXd& heights, const Eigen::Vector2d& from, double cell);

  bool covers(const Eigen::Vector2d& p) const { return (p.array() >= from_.array() && p.array() <= to_.array()).all(); }
  /// Precondition: covers(p).
  HeightJet operator()(const Eigen::Vector2d& p) const;

  const Eigen::Vector2d& from() const { return from_; }
  const Eigen::Vector2d& to() const { return to_; }
  double cell() const { return cell_; }

 private:
  Eigen::MatrixXd coefficients_;  // of cubic B-splines, one row and column more on each side
  Eigen::Vector2d from_, to_;
  double cell_;
};

inline constexpr std::size_t most_raster_points = 4'000'000;

/// An ESRI ASCII grid: lines ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize and perhaps NODATA_value, then the
/// heights, the
/// row of the greatest y first. A corner is half a cell outside of the first height. Throws ObstacleError: no such file, no such format,
/// too
/// many heights, heights missing or not finite.
Raster read_raster(const std::string& path);

}  // namespace plastron::obstacle
