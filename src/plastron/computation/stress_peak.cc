#include <plastron/computation/stress_peak.hpp>

#include <array>
#include <cstring>
#include <tuple>

namespace plastron::computation {

namespace {

/// Whether a is to be preferred: larger, or equal and first.
bool is_beyond(const StressPeak& a, const StressPeak& b) {
  return std::tuple(-a.von_mises, a.x[0], a.x[1]) < std::tuple(-b.von_mises, b.x[0], b.x[1]);
}

StressPeak peak_of(const recovery::PointValues& point) {
  const auto largest = shell::largest_von_mises(recovery::section_forces(point));
  return {.von_mises = largest.stress, .height = largest.height, .x = point.x, .position = point.phi};
}

}  // namespace

void choose_recovery(const Output& output, Solution& solution) {
  solution.recovery.axis = output.axis;
  solution.recovery.patches.reset();
  if (output.smooth)
    solution.recovery.patches = std::make_shared<recovery::ResultantPatches>(*solution.discrete, solution.nodal);
}

StressPeak stress_peak(const Solution& solution) {
  const fem::Space& space = solution.discrete->space();
  StressPeak peak;
  const recovery::Recovery recovery(*solution.discrete, solution.nodal, fem::lattice(space.shape(), space.degree),
                                    solution.recovery);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (const recovery::PointValues& point : recovery(cell)) {
      const StressPeak here = peak_of(point);
      if (here.von_mises > 0 && is_beyond(here, peak)) peak = here;
    }
  constexpr std::size_t size = sizeof(StressPeak) / sizeof(double);
  static_assert(sizeof(StressPeak) % sizeof(double) == 0);
  std::array<double, size> mine{};
  std::memcpy(mine.data(), &peak, sizeof peak);
  const std::vector<double> all = algebra::gather_over_ranks(mine, space.layout->comm);
  for (std::size_t rank = 0; rank < all.size() / size; ++rank) {
    StressPeak other;
    std::memcpy(static_cast<void*>(&other), all.data() + rank * size, sizeof other);
    if (other.von_mises > 0 && is_beyond(other, peak)) peak = other;
  }
  return peak;
}

}  // namespace plastron::computation
