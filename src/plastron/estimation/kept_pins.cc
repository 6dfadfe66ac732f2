#include <plastron/estimation/kept_pins.hpp>

#include <functional>
#include <numeric>

namespace plastron::estimation {

/// Whether the present factor suits these pins, if necessary after a cheap change of pins. Each unknown that differs
/// costs about one step of conjugate gradients.
bool KeptPins::is_near(std::span<const char> pinned, double shift) {
  const std::int64_t few = inner_.is_exact() ? 8 : 0;
  if (!is_ready_ || shift != shift_) return false;
  const auto changes_from = [&](std::span<const char> at_hand) {
    const auto changes = std::inner_product(pinned.begin(), pinned.end(), at_hand.begin(), std::int64_t{0},
                                            std::plus<>(), [](char a, char b) { return (a != 0) != (b != 0) ? 1 : 0; });
    return algebra::sum_over_ranks(changes, comm_);
  };
  if (changes_from(pinned_) <= few) return true;
  const std::vector<char> nearest = inner_.nearest_pins(pinned);
  if (algebra::sum_over_ranks(static_cast<std::int64_t>(nearest.size()), comm_) == 0 || changes_from(nearest) > few)
    return false;
  return pin_anew(nearest, shift) == algebra::Pinning::done;
}

algebra::Pinning KeptPins::pin(std::span<const char> pinned, double shift) {
  return keeps_ && is_near(pinned, shift) ? algebra::Pinning::done : pin_anew(pinned, shift);
}

algebra::Pinning KeptPins::pin_anew(std::span<const char> pinned, double shift) {
  const algebra::Pinning result = inner_.pin(pinned, shift);
  is_ready_ = result == algebra::Pinning::done;
  pinned_.assign(pinned.begin(), pinned.end());
  shift_ = shift;
  return result;
}

}  // namespace plastron::estimation
