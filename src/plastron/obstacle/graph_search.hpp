// Search for places on a graph z = h with a point nearer to X than a known one.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/raster.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <vector>

namespace plastron::obstacle {

/// Half the squared distance of X from the point of the graph z = h at p, with its derivatives with respect to p.
struct GraphObjective {
  double value;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian, convex_part;
};

inline GraphObjective graph_objective(const Vector3d& X, const Eigen::Vector2d& p, const HeightJet& h) {
  const Eigen::Vector2d across = p - X.head<2>();
  const double up = h.value - X[2];
  const Eigen::Matrix2d convex = Eigen::Matrix2d::Identity() + h.gradient * h.gradient.transpose();
  return {(across.squaredNorm() + up * up) / 2, across + up * h.gradient, convex + up * h.hessian, convex};
}

inline bool is_positive(const Eigen::Matrix2d& m) { return m(0, 0) > 0 && m.determinant() > 0; }

/// Samples of the graph on grids whose spacing halves from level to level. They are stored, because neighbouring points
/// need the same ones. Their places do not depend on earlier calls; therefore results do not either.
class GraphSamples {
 public:
  static constexpr int side = 8;
  static constexpr double least_samples_of_wave = 4;

  /// side x side samples in the middles of cells. Bounds of the height in all of these cells are estimated from
  /// slopes and second derivatives of samples.
  struct Block {
    std::array<HeightJet, side * side> jets;  // not finite where no height exists
    // `bend` is the largest |h''|.
    double low, high, bend;
    double change;  // largest change of h'' between neighbouring samples
    double range;   // range of the sampled heights
  };
  /// The square from width (i, j) to width (i + 1, j + 1). It consists of four squares of the next lower level.
  struct Index {
    int level;
    std::int64_t i, j;
    auto operator<=>(const Index&) const = default;

    double spacing() const;
    Eigen::Vector2d corner() const { return side * spacing() * Eigen::Vector2d(i, j); }
    Eigen::Vector2d place(std::size_t sample) const {
      const std::size_t row = sample / side, column = sample % side;
      return corner() + spacing() * Eigen::Vector2d(0.5 + static_cast<double>(row), 0.5 + static_cast<double>(column));
    }
  };

  /// The finest level with a spacing of at most `most`; the spacing is more than half of it.
  static int level_of(double most);

  /// `height` returns non-finite values where no height exists.
  explicit GraphSamples(std::function<HeightJet(const Eigen::Vector2d&)> height) : height_(std::move(height)) {}

  /// Returns a block, which stays in place until `forget_if_many`.
  const Block& block(const Index& index);
  /// Whether samples of this spacing miss waves of the height. The length of a wave follows from its height and its
  /// largest second derivative, and samples show both even if they miss the waves.
  static bool misses_waves(const Block& block, double spacing);
  void forget_if_many();

 private:
  struct Hash {
    std::size_t operator()(const Index& index) const;
  };
  Block sampled(const Index& index) const;

  std::function<HeightJet(const Eigen::Vector2d&)> height_;
  std::unordered_map<Index, std::size_t, Hash> numbers_;
  std::deque<Block> blocks_;  // the first numbers_.size() are in use; the others can be used again
};

/// Start of a descent of the distance.
struct GraphStart {
  double least;  ///< lower bound of half the squared distance there
  Eigen::Vector2d p;
  double spacing;  ///< spacing of the samples around it; feet within it are identical
};

struct GraphStarts {
  std::vector<GraphStart> starts{};  ///< most promising first
  double missed =
      0;  ///< spacing of the finest samples if they miss waves of the graph and the search therefore ends; else 0
};

/// Returns starts for all points within `reach` of X. The graph is sampled at least 8 times within the reach. Where
/// its curvature changes from sample to sample, it is sampled up to 128 times.
GraphStarts starts_nearer_than(double reach, const Vector3d& X, GraphSamples& samples);

}  // namespace plastron::obstacle
