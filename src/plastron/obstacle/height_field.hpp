// All that lies below a graph z = h(x, y), given by an expression or by a raster. Its distance is that to the graph, not the height above
// it.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/raster.hpp>

#include <memory>
#include <variant>

namespace plastron::obstacle {

class HeightField {
 public:
  /// Throws ObstacleError if the expression depends on Z.
  explicit HeightField(std::shared_ptr<const geometry::SpaceFunction> expression);
  explicit HeightField(std::shared_ptr<const Raster> raster) : heights_(std::move(raster)) {}

  /// The foot is the point (p, h(p)) of the graph where |X - foot| is least: Newton's method on p with a descent that cannot fail, from
  /// below X
  /// and from samples of the graph wherever one of them is nearer than the foot found. Throws ObstacleError where the foot is not inside
  /// of the raster.
  Nearest nearest(const Vector3d& X) const;

  /// z - h(x, y): zero on the graph, positive above; NaN outside of the raster.
  double level(const Vector3d& X) const;

 private:
  bool covers(const Eigen::Vector2d& p) const;
  HeightJet height(const Eigen::Vector2d& p) const;
  Eigen::Vector2d descend(const Vector3d& X, Eigen::Vector2d p) const;
  bool leave_for_nearer_sample(const Vector3d& X, Eigen::Vector2d& p) const;
  [[noreturn]] void refuse(const Vector3d& X, const char* what) const;

  std::variant<std::shared_ptr<const geometry::SpaceFunction>, std::shared_ptr<const Raster>> heights_;
};

}  // namespace plastron::obstacle
