#include <plastron/estimation/kept_factorisation.hpp>

#include <functional>
#include <numeric>

namespace plastron::estimation {

/// Whether the present factor suits this set, if necessary after a cheap change. Each unknown that differs
/// costs about one step of conjugate gradients.
bool KeptFactorisation::is_near(std::span<const char> fixed, double shift) {
  constexpr std::int64_t few = 8;
  if (!is_ready_ || shift != shift_) return false;
  const auto changes_from = [&](std::span<const char> at_hand) {
    const auto changes = std::inner_product(fixed.begin(), fixed.end(), at_hand.begin(), std::int64_t{0}, std::plus<>(),
                                            [](char a, char b) { return (a != 0) != (b != 0) ? 1 : 0; });
    return algebra::sum_over_ranks(changes, comm_);
  };
  if (changes_from(fixed_) <= few) return true;
  const std::vector<char> nearest = inner_.nearest_fixed(fixed);
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(nearest.size()), comm_) == 0 || changes_from(nearest) > few)
    return false;
  return fix_anew(nearest, shift);
}

bool KeptFactorisation::fix(std::span<const char> fixed, double shift) {
  return (keeps_ && is_near(fixed, shift)) || fix_anew(fixed, shift);
}

bool KeptFactorisation::fix_anew(std::span<const char> fixed, double shift) {
  is_ready_ = inner_.fix(fixed, shift);
  fixed_.assign(fixed.begin(), fixed.end());
  shift_ = shift;
  return is_ready_;
}

}  // namespace plastron::estimation
