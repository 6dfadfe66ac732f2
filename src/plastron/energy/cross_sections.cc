#include <plastron/energy/cross_sections.hpp>

#include <plastron/algebra/assertion.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace plastron::energy {

const std::string& region_of(const mesh::CoarseMesh& coarse, const fem::Cell& cell) {
  PLASTRON_ASSERT(cell.coarse >= 0 && static_cast<std::size_t>(cell.coarse) < coarse.cells.size(), cell.coarse,
                  coarse.cells.size());
  return coarse.regions[static_cast<std::size_t>(coarse.cells[static_cast<std::size_t>(cell.coarse)].region)];
}

const CrossSection& CrossSections::at(const mesh::CoarseMesh& coarse, const fem::Cell& cell) const {
  if (regions.empty()) return common;
  const auto own = regions.find(region_of(coarse, cell));
  return own == regions.end() ? common : own->second;
}

const shell::Material& CrossSections::softest() const {
  const CrossSection* softest = &common;
  for (const auto& [name, section] : regions)
    if (section.material.young() < softest->material.young()) softest = &section;
  return softest->material;
}

int CrossSections::most_layers() const {
  const auto count = [](const CrossSection& section) {
    const auto laminate = section.material.laminate();
    return laminate ? static_cast<int>(laminate->layers().size()) : 0;
  };
  int most = count(common);
  for (const auto& [name, section] : regions) most = std::max(most, count(section));
  return most;
}

void check_regions(const CrossSections& sections, const mesh::CoarseMesh& coarse) {
  for (const auto& [name, section] : sections.regions)
    if (std::ranges::find(coarse.regions, name) == coarse.regions.end())
      throw mesh::DomainError(fmt::format(
          "a thickness, material, density or temperature is given for the region \"{}\", which the mesh does not have; "
          "it has: {}",
          name, fmt::join(coarse.regions, ", ")));
}

}  // namespace plastron::energy
