#include <plastron/recovery/stress_peak.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/assembly/nodal_geometry.hpp>
#include <plastron/solution/place_order.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::recovery {

namespace {

/// Stresses above this part of the largest one count as equal up to rounding.
constexpr double same = 1 - 1e-9;

StressPeak peak_of(const PointValues& point) {
  const auto largest = shell::largest_von_mises(section_forces(point));
  return {.von_mises = largest.stress, .height = largest.height, .x = point.x, .position = point.phi};
}

/// The largest peaks of this rank, equal up to rounding.
std::vector<StressPeak> local_peaks(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                    const Choice& choice, std::span<const SingularPlace> singular) {
  const fem::Space& space = discrete.space();
  const std::vector<Eigen::Vector2d> lattice = mesh::lattice(space.shape(), space.degree);
  const Recovery recovery(discrete, solution, lattice, choice);
  std::vector<StressPeak> peaks;
  double most = 0;
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    const std::vector<PointValues> points = recovery(cell);
    for (std::size_t p = 0; p < points.size(); ++p) {
      StressPeak here = peak_of(points[p]);
      if (!(here.von_mises > 0) || here.von_mises < same * most || is_singular(here.position, singular)) continue;
      most = std::max(most, here.von_mises);
      here.cell = cell;
      here.xi = lattice[p];
      peaks.push_back(here);
    }
  }
  std::erase_if(peaks, [&](const StressPeak& peak) { return peak.von_mises < same * most; });
  return peaks;
}

/// Whether a's place comes first; at the same place the upper face comes first.
bool is_before(const StressPeak& a, const StressPeak& b, double size) {
  const auto first = solution::in_units(a.position, size), second = solution::in_units(b.position, size);
  return first != second ? first < second : a.height > b.height;
}

/// The difference to the stress from the cell's resultants alone, computed on the peak's rank; the same on all ranks
/// (collective).
double error_of(const StressPeak& peak, const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                const Choice& choice) {
  const MPI_Comm comm = discrete.space().layout->comm;
  if (!choice.patches) return std::numeric_limits<double>::quiet_NaN();
  double error = 0;
  if (algebra::rank_in(comm) == peak.rank && peak.von_mises > 0) {
    const PointValues alone = Recovery(discrete, solution, {peak.xi}, {.axis = choice.axis})(peak.cell).front();
    error = std::abs(peak.von_mises - shell::largest_von_mises(section_forces(alone)).stress);
  }
  return algebra::sum_over_ranks(error, comm);
}

}  // namespace

StressPeak stress_peak(const assembly::DiscreteShell& discrete, const NodalSolution& solution, const Choice& choice,
                       std::span<const SingularPlace> singular) {
  const MPI_Comm comm = discrete.space().layout->comm;
  std::vector<StressPeak> mine = local_peaks(discrete, solution, choice, singular);
  for (StressPeak& p : mine) p.rank = algebra::rank_in(comm);
  const std::vector<StressPeak> all = algebra::gathered(mine, comm);
  double most = 0;
  for (const StressPeak& p : all) most = std::max(most, p.von_mises);
  const auto place = [&](std::size_t i) { return discrete.points[i].phi; };
  const double size = assembly::bounding_box(discrete.points.size(), place, comm).half_diagonal();
  StressPeak peak;
  for (const StressPeak& here : all)
    if (here.von_mises >= same * most && (peak.von_mises == 0 || is_before(here, peak, size))) peak = here;
  peak.error = error_of(peak, discrete, solution, choice);
  return peak;
}

}  // namespace plastron::recovery
