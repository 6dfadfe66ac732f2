#include <plastron/recovery/layer_stresses.hpp>

#include <plastron/algebra/gathered.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace plastron::recovery {

namespace {

constexpr std::array components{"11", "22", "12", "13", "23"};

/// The most and the least of one component, the least with the sign changed: both are maxima.
using Extremes = std::array<PlacedStress, 2>;

PlacedStress nowhere() { return {.stress = -std::numeric_limits<double>::infinity()}; }

/// Whether a takes the place of b. Stresses that are equal up to rounding are ordered by their places.
bool replaces(const PlacedStress& a, const PlacedStress& b) {
  const double rounding = 1e-9 * std::abs(b.stress);
  if (std::isinf(b.stress) || std::abs(a.stress - b.stress) > rounding) return a.stress > b.stress;
  for (Eigen::Index k = 0; k < 3; ++k)
    if (std::abs(a.position[k] - b.position[k]) > 1e-9 * (a.position.norm() + b.position.norm()))
      return a.position[k] < b.position[k];
  return a.height > b.height;
}

/// Layers of a region of the coarse mesh, and their place in the list of extremes.
struct RegionLayers {
  std::string name;
  std::shared_ptr<const shell::Laminate> laminate;
  std::size_t first;
};

std::vector<RegionLayers> regions_with_layers(const assembly::DiscreteShell& discrete) {
  std::vector<RegionLayers> all;
  std::size_t first = 0;
  for (const std::string& name : discrete.space().coarse->regions) {
    const auto& sections = discrete.shell.sections();
    const auto own = sections.regions.find(name);
    const auto laminate = (own == sections.regions.end() ? sections.common : own->second).material.laminate();
    if (!laminate) continue;
    all.push_back({name, laminate, first});
    first += laminate->layers().size();
  }
  return all;
}

class LayerSearch {
 public:
  LayerSearch(std::vector<RegionLayers> regions, std::span<const SingularPlace> singular)
      : regions_(std::move(regions)), singular_(singular) {
    const RegionLayers& last = regions_.back();
    extremes_.assign((last.first + last.laminate->layers().size()) * components.size(), Extremes{nowhere(), nowhere()});
  }

  void search(const assembly::DiscreteShell& discrete, const NodalSolution& solution, const Choice& choice) {
    const fem::Space& space = discrete.space();
    const Recovery recovery(discrete, solution, mesh::lattice(space.shape(), space.degree), choice);
    for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
      const auto region =
          std::ranges::find(regions_, energy::region_of(*space.coarse, space.cells[cell]), &RegionLayers::name);
      if (region == regions_.end()) continue;
      for (const PointValues& point : recovery(cell))
        if (!is_singular(point.phi, singular_)) look_at(point, region->first);
    }
  }

  /// Makes the extremes those of all ranks (collective).
  void gather(MPI_Comm comm) {
    const std::vector<Extremes> all = algebra::gathered(extremes_, comm);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) take(all[i][k], extremes_[i % extremes_.size()][k]);
  }

  std::vector<LayerStress> list() const {
    std::vector<LayerStress> all;
    for (const RegionLayers& region : regions_)
      for (std::size_t k = 0; k < region.laminate->layers().size(); ++k)
        for (std::size_t c = 0; c < components.size(); ++c) {
          const Extremes& both = extremes_[(region.first + k) * components.size() + c];
          if (std::isinf(both[0].stress)) continue;
          LayerStress& s =
              all.emplace_back(LayerStress{.region = region.name,
                                           .layer = static_cast<int>(k) + 1,
                                           .angle = region.laminate->layers()[k].angle * 180 / std::numbers::pi,
                                           .component = components[c],
                                           .most = both[0],
                                           .least = both[1]});
          s.least.stress *= -1;
        }
    return all;
  }

 private:
  void look_at(const PointValues& point, std::size_t first) {
    const shell::SectionForces forces = section_forces(point);
    for (std::size_t k = 0; k < forces.laminate->layer_count(); ++k) {
      const double bottom = forces.laminate->interface(k), top = forces.laminate->interface(k + 1);
      for (const double z : {top, (bottom + top) / 2, bottom}) {
        const shell::Stress s = shell::stress_of(forces.laminate->stress_in_layer_axes(k, z), forces);
        const std::array<double, 5> values{s.in_plane[0], s.in_plane[1], s.in_plane[2], s.shear[0], s.shear[1]};
        for (std::size_t c = 0; c < components.size(); ++c) {
          Extremes& both = extremes_[(first + k) * components.size() + c];
          for (const int sign : {1, -1})
            take({.stress = sign * values[c], .height = z, .x = point.x, .position = point.phi},
                 both[sign > 0 ? 0 : 1]);
        }
      }
    }
  }

  static void take(const PlacedStress& found, PlacedStress& best) {
    if (found.stress > -std::numeric_limits<double>::infinity() && replaces(found, best)) best = found;
  }

  std::vector<RegionLayers> regions_;
  std::span<const SingularPlace> singular_;
  std::vector<Extremes> extremes_{};
};

}  // namespace

std::vector<LayerStress> layer_stresses(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                        const Choice& choice, std::span<const SingularPlace> singular) {
  auto regions = regions_with_layers(discrete);
  if (regions.empty()) return {};
  LayerSearch search(std::move(regions), singular);
  search.search(discrete, solution, choice);
  search.gather(discrete.space().layout->comm);
  return search.list();
}

}  // namespace plastron::recovery
