// The cross-section of the shell at a point of its mid-surface: thickness, elastic constants and density. A region of
// the domain may have its own values (M7 to M9).
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/geometry/expression.hpp>
#include <plastron/shell/material.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace plastron::assembly {

struct CrossSection {
  geometry::Expression thickness{1.0};  ///< e(x, y) [m]
  shell::Material material{};
  double density = 0;  ///< rho [kg/m^3]; 0: no weight
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
  /// Whether some layer has initial strains. (Inline, as has_mass(): the front program does not load the folder's libraries.)
  bool have_initial_strains() const {
    const auto has_them = [](const CrossSection& section) {
      const auto laminate = section.material.laminate();
      return laminate && laminate->has_initial_strains();
    };
    return has_them(common) || std::ranges::any_of(regions, [&](const auto& own) { return has_them(own.second); });
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

}  // namespace plastron::assembly
