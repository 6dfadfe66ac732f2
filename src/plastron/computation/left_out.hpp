// Energies that the linear model omits, as parts of the stored energy of a solution (docs/theory.md, "What linearity
// leaves out").
#pragma once
#include <plastron/computation/result.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace plastron::computation {

struct LeftOut {
  double work = 0;                            ///< |int N^{ab} q_ab dS|, q_ab = 1/2 d_a u . d_b u
  double stretch = 0;                         ///< 1/2 int e a^{abrs} q_ab q_rs dS
  std::optional<double> remaining_stretch{};  ///< the part of it that no further displacement removes
  double rotation = 0;  ///< half the square of the largest rotation: the relative change of lengths

  /// Returns the largest doubtful part of the energy. Without remaining_stretch, the whole stretch is used.
  double largest() const { return std::max({work, remaining_stretch.value_or(stretch), rotation}); }
};

inline LeftOut left_out(const solution::Summary& summary, const Level& level) {
  LeftOut part{.work = std::abs(summary.over_stored(summary.second_order.work)),
               .stretch = summary.over_stored(summary.second_order.stretch),
               .rotation = summary.max_rotation * summary.max_rotation / 2};
  if (summary.is_unstrained)
    part.remaining_stretch = 0;  // a rigid motion: the exact rotation removes all of it
  else if (level.linearity.remaining_stretch)
    part.remaining_stretch = std::abs(summary.over_stored(*level.linearity.remaining_stretch));
  return part;
}

}  // namespace plastron::computation
