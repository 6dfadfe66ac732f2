#include <plastron/obstacle/graph_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plastron::obstacle {

namespace {

/// The spacing of level 0. It is no simple fraction, so that samples do not fall on the same phase of all waves of a
/// user.
constexpr double unit_spacing = 0.7320508075688772;

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

}  // namespace plastron::obstacle
