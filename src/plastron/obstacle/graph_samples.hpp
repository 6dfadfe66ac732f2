// Samples of a graph z = h on grids that halve their spacing from level to level. They are kept, for neighbouring
// points ask for the same ones; where they lie depends on nothing that was asked before, and so no answer does.
#pragma once
#include <plastron/obstacle/raster.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>

namespace plastron::obstacle {

class GraphSamples {
 public:
  static constexpr int side = 8;
  static constexpr double least_samples_of_wave = 4;

  /// side x side samples in the middles of cells. Bounds of the height in all of these cells are estimates: from slopes
  /// and second derivatives of samples.
  struct Block {
    std::array<HeightJet, side * side> jets;  // not finite where there is no height
    double low, high, bend;                   // greatest |h''|
    double change;                            // of h'' from sample to sample, the greatest
    double range;                             // of the sampled heights
  };
  /// The square from width (i, j) to width (i + 1, j + 1), and it is four of the next lower level.
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

  /// The finest level whose spacing is at most `most` and more than half of it.
  static int level_of(double most);

  /// `height` gives what is not finite where there is none.
  explicit GraphSamples(std::function<HeightJet(const Eigen::Vector2d&)> height) : height_(std::move(height)) {}

  /// Stays where it is until `forget_if_many`.
  const Block& block(const Index& index);
  /// Samples of this spacing miss waves of the height. Its waves are as short as their height and their greatest second derivative make them, so
  /// samples that miss them cannot hide that.
  static bool misses_waves(const Block& block, double spacing);
  void forget_if_many();

 private:
  struct Hash {
    std::size_t operator()(const Index& index) const;
  };
  Block sampled(const Index& index) const;

  std::function<HeightJet(const Eigen::Vector2d&)> height_;
  std::unordered_map<Index, std::size_t, Hash> numbers_;
  std::deque<Block> blocks_;  // the first numbers_.size() are in use; the others wait to be used again
};

}  // namespace plastron::obstacle
