// What the shell consists of at a point of its mid-surface: thickness, elastic constants and density, which a region of
// the domain may have of its own (M7 to M9).
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/geometry/expression.hpp>
#include <plastron/shell/material.hpp>

#include <map>
#include <string>

namespace plastron::assembly {

struct CrossSection {
  geometry::Expression thickness{1.0};  ///< e(x, y) [m]
  shell::Material material{};
  double density = 0;  ///< rho [kg/m^3]; 0: without weight
};

struct CrossSections {
  CrossSection common{};                          ///< of the regions that have none of their own
  std::map<std::string, CrossSection> regions{};  ///< by name of the region

  /// That of the region in which a cell lies.
  const CrossSection& at(const fem::CoarseMesh& coarse, const fem::Cell& cell) const;
  /// The material of the smallest E: what measures of the whole shell are safe against.
  const shell::Material& softest() const;
};

/// The name of the region in which a cell lies.
const std::string& region_of(const fem::CoarseMesh& coarse, const fem::Cell& cell);

/// Throws fem::DomainError where a region is named that the mesh does not have.
void check_regions(const CrossSections& sections, const fem::CoarseMesh& coarse);

}  // namespace plastron::assembly
