// The body below a graph z = h(x, y), given by an expression or by a raster. Its distance is the distance to the
// graph, not the height above it.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/raster.hpp>

#include <memory>
#include <string>
#include <variant>

namespace plastron::obstacle {

class GraphSamples;

class HeightField {
 public:
  /// Throws ObstacleError if the expression depends on Z.
  explicit HeightField(std::shared_ptr<const geometry::SpaceFunction> expression);
  explicit HeightField(std::shared_ptr<const Raster> raster);

  /// The foot is the point (p, h(p)) of the graph with the least |X - foot|. Newton's method on p, with a descent
  /// that always succeeds, starts below X and where samples show that a nearer foot is possible. Copies share the
  /// samples, so they must not be used by several threads at once. Results do not depend on earlier calls. Throws
  /// ObstacleError if the foot is not inside the raster.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const { return {}; }

  /// z - h(x, y): zero on the graph, positive above; NaN outside of the raster.
  double level(const Vector3d& X) const;

 private:
  /// End of a descent, half its squared distance, and whether this is a local minimum.
  struct Foot {
    Eigen::Vector2d p;
    HeightJet h;
    double value;
    bool is_stationary;
  };

  bool covers(const Eigen::Vector2d& p) const;
  HeightJet height(const Eigen::Vector2d& p) const;
  Foot descend(const Vector3d& X, Eigen::Vector2d p) const;
  bool is_surely_nearest(const Vector3d& X, const Foot& foot) const;
  Foot nearer_foot(const Vector3d& X, const Foot& known) const;
  bool is_raster() const { return heights_.index() == 1; }
  [[noreturn]] void refuse(const std::string& what) const;

  std::variant<std::shared_ptr<const geometry::SpaceFunction>, std::shared_ptr<const Raster>> heights_;
  std::shared_ptr<GraphSamples> samples_;
};

}  // namespace plastron::obstacle
