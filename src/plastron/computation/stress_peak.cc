#include <plastron/computation/stress_peak.hpp>

#include <plastron/assembly/bounding_box.hpp>
#include <plastron/certificate/place_order.hpp>

namespace plastron::computation {

namespace {

/// Stresses in this part of the largest one are equal up to rounding.
constexpr double same = 1 - 1e-9;

StressPeak peak_of(const recovery::PointValues& point) {
  const auto largest = shell::largest_von_mises(recovery::section_forces(point));
  return {.von_mises = largest.stress, .height = largest.height, .x = point.x, .position = point.phi};
}

/// The largest ones of this rank, equal up to rounding.
std::vector<StressPeak> local_peaks(const Solution& solution) {
  const fem::Space& space = solution.discrete->space();
  const recovery::Recovery recovery(*solution.discrete, solution.nodal, fem::lattice(space.shape(), space.degree),
                                    solution.recovery);
  std::vector<StressPeak> peaks;
  double most = 0;
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (const recovery::PointValues& point : recovery(cell)) {
      const StressPeak here = peak_of(point);
      if (!(here.von_mises > 0) || here.von_mises < same * most) continue;
      most = std::max(most, here.von_mises);
      peaks.push_back(here);
    }
  std::erase_if(peaks, [&](const StressPeak& peak) { return peak.von_mises < same * most; });
  return peaks;
}

/// Whether a's place comes first; of one place, the upper face.
bool is_before(const StressPeak& a, const StressPeak& b, double size) {
  const auto first = certificate::in_units(a.position, size), second = certificate::in_units(b.position, size);
  return first != second ? first < second : a.height > b.height;
}

}  // namespace

void choose_recovery(const Output& output, Solution& solution) {
  solution.recovery.axis = output.axis;
  solution.recovery.patches.reset();
  if (output.smooth)
    solution.recovery.patches = std::make_shared<recovery::ResultantPatches>(*solution.discrete, solution.nodal);
}

StressPeak stress_peak(const Solution& solution) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const MPI_Comm comm = discrete.space().layout->comm;
  constexpr std::size_t entries = 7;  // stress, height, x, position
  std::vector<double> mine;
  for (const StressPeak& p : local_peaks(solution)) {
    mine.insert(mine.end(), {p.von_mises, p.height, p.x[0], p.x[1]});
    mine.insert(mine.end(), p.position.begin(), p.position.end());
  }
  const std::vector<double> all = algebra::gather_over_ranks(mine, comm);
  double most = 0;
  for (std::size_t at = 0; at < all.size(); at += entries) most = std::max(most, all[at]);
  const auto place = [&](std::size_t i) { return discrete.points[i].phi; };
  const double size = assembly::bounding_box(discrete.points.size(), place, comm).half_diagonal();
  StressPeak peak;
  for (std::size_t at = 0; at < all.size(); at += entries) {
    const double* v = all.data() + at;
    const StressPeak here{.von_mises = v[0], .height = v[1], .x = {v[2], v[3]}, .position = {v[4], v[5], v[6]}};
    if (here.von_mises >= same * most && (peak.von_mises == 0 || is_before(here, peak, size))) peak = here;
  }
  return peak;
}

}  // namespace plastron::computation
