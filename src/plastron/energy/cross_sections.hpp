// The cross-section of the shell at a point of its mid-surface: thickness, elastic constants and density. A region of
// the domain may have its own values (M7 to M9).
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/geometry/expression.hpp>
#include <plastron/shell/material.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace plastron::energy {

/// A temperature over that without stress, T_m + (z / e) dT (M34).
struct Temperature {
  geometry::Expression mean{};        ///< T_m [K]
  geometry::Expression difference{};  ///< dT, upper face less lower face [K]
  int factor = -1;                    ///< see Factors::named
};

struct CrossSection {
  geometry::Expression thickness{1.0};  ///< e(x, y) [m]
  shell::Material material{};
  double density = 0;                       ///< rho [kg/m^3]; 0: no weight
  std::vector<Temperature> temperatures{};  ///< they add up

  /// Whether it has strains without stress. (Inline, as what follows: the front program does not load the folder's libraries.)
  bool has_initial_strains() const {
    const auto laminate = material.laminate();
    return (laminate && laminate->has_initial_strains()) || (!temperatures.empty() && material.expands());
  }
};

struct CrossSections {
  CrossSection common{};                          ///< for regions without their own cross-section
  std::map<std::string, CrossSection> regions{};  ///< cross-sections by name of region

  /// Returns the cross-section of the region that contains a cell.
  const CrossSection& at(const mesh::CoarseMesh& coarse, const fem::Cell& cell) const;
  /// Whether some part has a density.
  bool has_mass() const {
    for (const auto& [name, section] : regions)
      if (section.density > 0) return true;
    return common.density > 0;
  }
  /// Whether some region has strains without stress.
  bool have_initial_strains() const {
    return common.has_initial_strains() ||
           std::ranges::any_of(regions, [](const auto& own) { return own.second.has_initial_strains(); });
  }
  /// Whether some region has temperatures.
  bool are_heated() const {
    return !common.temperatures.empty() ||
           std::ranges::any_of(regions, [](const auto& own) { return !own.second.temperatures.empty(); });
  }
  /// Returns the largest number of layers of a laminate; 0 without laminates.
  int most_layers() const;
  /// Returns the material of the smallest E. With it, measures of the whole shell are conservative.
  const shell::Material& softest() const;
};

/// Returns the name of the region that contains a cell.
const std::string& region_of(const mesh::CoarseMesh& coarse, const fem::Cell& cell);

/// Throws mesh::DomainError where `sections` name a region that the mesh does not have.
void check_regions(const CrossSections& sections, const mesh::CoarseMesh& coarse);

}  // namespace plastron::energy
