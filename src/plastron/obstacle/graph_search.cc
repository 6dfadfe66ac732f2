#include <plastron/obstacle/graph_search.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plastron::obstacle {

namespace {

/// The spacing of level 0. It is no simple fraction, so that samples do not fall on the same phase of all waves of a
/// user.
constexpr double unit_spacing = 0.7320508075688772;

using Eigen::Vector2d;
using Index = GraphSamples::Index;
using Block = GraphSamples::Block;

/// Skips blocks whose bounds are farther than the nearest sample. Divides blocks whose samples are too sparse for a
/// decision.
class GraphSearch {
 public:
  GraphSearch(double reach, const Vector3d& X, GraphSamples& samples)
      : samples_(samples), X_(X), reach_(reach), best_(reach * reach / 2 * (1 - 1e-9)) {}

  GraphStarts starts() {
    constexpr double samples_of_reach = 8;
    const int level = GraphSamples::level_of(reach_ / samples_of_reach);
    const double width = GraphSamples::side * Index{level, 0, 0}.spacing();
    const auto at = [&](double x) { return static_cast<std::int64_t>(std::floor(x / width)); };
    for (std::int64_t i = at(X_[0] - reach_); i <= at(X_[0] + reach_); ++i)
      for (std::int64_t j = at(X_[1] - reach_); j <= at(X_[1] + reach_) && missed_ == 0; ++j) visit({level, i, j}, 0);
    std::erase_if(found_, [&](const GraphStart& start) { return start.least > best_; });
    std::ranges::stable_sort(found_, {}, &GraphStart::least);
    return {std::move(found_), missed_};
  }

 private:
  bool is_resolved(const Block& block) const {
    constexpr double alike = 0.3, share_of_bend = 0.7;
    return block.change * reach_ < alike || block.change < share_of_bend * block.bend;
  }

  void visit(const Index& index, int depth) {
    const double spacing = index.spacing();
    const Vector2d x = X_.head<2>(), corner = index.corner();
    const Vector2d opposite = corner.array() + GraphSamples::side * spacing;
    const double across = (x - x.cwiseMax(corner).cwiseMin(opposite)).squaredNorm();
    if (across >= 2 * best_) return;
    const Block& block = samples_.block(index);
    const double up = std::max({0.0, X_[2] - block.high, block.low - X_[2]});
    if (across + up * up >= 2 * best_ || missed_ > 0) return;
    constexpr int most_divisions = 4;
    if (depth == most_divisions && GraphSamples::misses_waves(block, spacing)) {
      missed_ = spacing;
      return;
    }
    if (is_resolved(block) || depth == most_divisions) return scan(index, block);
    for (const int i : {0, 1})
      for (const int j : {0, 1}) visit({index.level - 1, 2 * index.i + i, 2 * index.j + j}, depth + 1);
  }

  void scan(const Index& index, const Block& block) {
    const double spacing = index.spacing(), radius = spacing / std::sqrt(2.0);
    for (std::size_t k = 0; k < block.jets.size(); ++k) {
      const HeightJet& h = block.jets[k];
      const Vector2d p = index.place(k), across = p - X_.head<2>();
      const double up = h.value - X_[2], value = (across.squaredNorm() + up * up) / 2;
      const double curvature = std::max(0.0, std::abs(up) * block.bend - 1);
      const double least = value - radius * (across + up * h.gradient).norm() - curvature * radius * radius / 2;
      if (!(least < best_)) continue;
      if (value < best_) best_ = value;
      look_at(p, h, least, block.change, spacing);
    }
  }

  /// Adds the minimum of the quadratic model if it is in reach of the sample; allows for the error of the model.
  void look_at(const Vector2d& p, const HeightJet& h, double least, double change, double spacing) {
    const GraphObjective f = graph_objective(X_, p, h);
    if (!is_positive(f.hessian)) return found_.push_back({least, p, spacing});
    const Vector2d step = -f.hessian.inverse() * f.gradient;
    if (step.lpNorm<Eigen::Infinity>() > 1.5 * spacing && f.value > best_) return;
    const double granted = std::abs(h.value - X_[2]) * change * step.squaredNorm() / 2;
    const double predicted = f.value + f.gradient.dot(step) / 2 - granted;
    if (predicted < best_) found_.push_back({predicted, p + step, spacing});
  }

  GraphSamples& samples_;
  const Vector3d X_;
  double reach_, best_;
  double missed_ = 0;
  std::vector<GraphStart> found_;
};

}  // namespace

double GraphSamples::Index::spacing() const { return std::ldexp(unit_spacing, level); }

int GraphSamples::level_of(double most) { return std::ilogb(most / unit_spacing); }

std::size_t GraphSamples::Hash::operator()(const Index& index) const {
  std::uint64_t h = static_cast<std::uint64_t>(index.level);
  for (const std::int64_t k : {index.i, index.j})
    h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
  return h;
}

GraphSamples::Block GraphSamples::sampled(const Index& index) const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double spacing = index.spacing();
  Block block{.jets = {}, .low = inf, .high = -inf, .bend = 0, .change = 0, .range = 0};
  double least = inf, most = -inf;
  for (std::size_t k = 0; k < block.jets.size(); ++k) {
    const HeightJet& h = block.jets[k] = height_(index.place(k));
    if (!std::isfinite(h.value) || !h.gradient.allFinite() || !h.hessian.allFinite()) continue;
    const double within = spacing / 2 * h.gradient.lpNorm<1>();
    block.low = std::min(block.low, h.value - within);
    block.high = std::max(block.high, h.value + within);
    block.bend = std::max(block.bend, h.hessian.norm());
    least = std::min(least, h.value);
    most = std::max(most, h.value);
    const auto compare = [&](std::size_t other) {
      const double change = (h.hessian - block.jets[other].hessian).norm();
      if (change > block.change) block.change = change;
    };
    if (k >= side) compare(k - side);
    if (k % side > 0) compare(k - 1);
  }
  // Twice the contribution of the largest sampled second derivative.
  block.low -= block.bend * spacing * spacing / 2;
  block.high += block.bend * spacing * spacing / 2;
  block.range = std::max(0.0, most - least);
  return block;
}

const GraphSamples::Block& GraphSamples::block(const Index& index) {
  const auto [found, is_new] = numbers_.try_emplace(index, numbers_.size());
  if (!is_new) return blocks_[found->second];
  if (found->second == blocks_.size()) blocks_.emplace_back();
  return blocks_[found->second] = sampled(index);
}

// A wave of length L with heights in a range a has |h''| up to a / 2 (2 pi / L)^2.
bool GraphSamples::misses_waves(const Block& block, double spacing) {
  const double turn = 2 * std::numbers::pi / (least_samples_of_wave * spacing);
  return block.bend > block.range / 2 * turn * turn;
}

void GraphSamples::forget_if_many() {
  constexpr std::size_t most_blocks = 40000;  // blocks of 4 kB
  if (numbers_.size() > most_blocks) numbers_.clear();
}

GraphStarts starts_nearer_than(double reach, const Vector3d& X, GraphSamples& samples) {
  return GraphSearch(reach, X, samples).starts();
}

}  // namespace plastron::obstacle
