// Checks elements, thickness and materials: where elements without tying lock, where rounding hides the solution, where no material
// has the modulus or the density, and where one director does not describe a laminate.
#include <plastron/computation/warnings.hpp>
#include <plastron/examination/checks.hpp>
#include <plastron/meshing/sizes.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace plastron::examination {

void check_locking(Examined& examined) {
  for (const std::string& warning : computation::locking_warnings(examined.problem))
    examined.add(Severity::warning, "{}", warning);
}

void check_soft_layers(Examined& examined) {
  constexpr double notable = 0.1;  // part of the size: a span of this size then deflects about 5 % too much
  double worst = 0;
  const std::vector<Eigen::Vector2d> middle{mesh::centre(examined.space->shape())};
  std::vector<double> e(1);
  for (const fem::Cell& cell : examined.space->cells) {
    const auto& section = examined.problem.shell.sections.at(*examined.space->coarse, cell);
    const auto laminate = section.material.laminate();
    if (!laminate) continue;
    examined.surface->evaluate(section.thickness, cell, middle, e);
    worst = std::max(worst, e[0] * laminate->face_length());
  }
  if (worst <= notable * examined.size) return;
  examined.add(
      Severity::warning,
      "the soft layers of a laminate let its faces bend each on its own over {:.3g} m, and the shell is only about "
      "{:.3g} m wide: one director does not describe this section, displacements are too large and bending of the "
      "faces is "
      "missing; use a stiffer core, or a solid or layerwise program",
      worst, 2 * examined.size);
}

void check_materials(Examined& examined) {
  const problem::UnitNames& units = examined.problem.output.units;
  if (!units.are_stated) return;
  struct Range {
    const char *what, *below, *above;
    double least, most, steel;  // SI
    std::optional<double> unit;
    std::string unit_name;
  };
  // 4e5 Pa is above all metals in MPa. A mass is force s^2 / length.
  const Range moduli{"modulus of elasticity", "below rubber's", "above diamond's", 4e5, 2e12, 2.1e11,
                     units.in_SI(1, -2),      units.label("Pa")};
  const Range densities{"density",
                        "below a foam's",
                        "above any metal's",
                        1,
                        3e4,
                        7850,
                        units.in_SI(1, -4),
                        units.label("N") + " s^2/" + units.label("m") + "^4"};
  const auto check = [&](const Range& range, double value, const std::string& place) {
    const double in_SI = value * range.unit.value_or(0);
    if (!range.unit || value == 0 || (in_SI >= range.least && in_SI <= range.most)) return;
    examined.add(Severity::warning,
                 "{}the {} {:.4g} {} is {}: with length = \"{}\" and force = \"{}\" in [units], steel has {:.3g} {}; "
                 "correct the value or the units",
                 place, range.what, value, range.unit_name, in_SI < range.least ? range.below : range.above,
                 units.length, units.force, range.steel / *range.unit, range.unit_name);
  };
  const auto check_section = [&](const energy::CrossSection& section, const std::string& place) {
    check(moduli, section.material.young(), place);
    check(densities, section.density, place);
  };
  const energy::CrossSections& sections = examined.problem.shell.sections;
  const auto has_own = [&](const std::string& name) { return sections.regions.contains(name); };
  if (!std::ranges::all_of(examined.space->coarse->regions, has_own)) check_section(sections.common, "");
  for (const auto& [name, section] : sections.regions) check_section(section, fmt::format("in \"{}\" ", name));
}

void check_weight(Examined& examined) {
  const problem::Problem& p = examined.problem;
  if (p.shell.sections.has_mass() && p.shell.loads.gravity.isZero(0) && p.modes.vibration == 0)
    examined.add(
        Severity::warning,
        "a density is given, but nothing pulls at it: the shell has no weight; for its weight add [gravity] with "
        "acceleration = [0, 0, -9.81], for natural frequencies ask plastron modes");
}

double rounding_residual(const problem::Problem& problem) {
  // Membrane strains of a bending are differences of displacements. Rounding eps w over the distance h of nodes has the
  // energy e (eps w / h)^2. It acts against the bending energy e^3 (w / L^2)^2. The factor gives an order of magnitude:
  // on the strip of cases/inclined-strip, loads ~ e^3, degree 3, the certificate's energy identity was 1.3e-5 and
  // 7.9e-4 at e = 1e-5 and 1e-6 m with 48 intervals, 1.1e-5 at 1e-4 m with 192, within a factor of 6 of this.
  // Stationarity was smaller by 5 to 200. Other shells were not measured.
  constexpr double factor = 0.04;
  const double L = meshing::extent(problem);
  double worst = 0;
  for (const auto& [h, e] : meshing::cell_sizes(problem))
    worst = std::max(worst, L / e * (L / h) * problem.discretisation.degree);
  return factor * std::numeric_limits<double>::epsilon() * worst * worst;
}

void check_precision(Examined& examined) {
  constexpr double poor = 5e-5;  // half of the certificate's limit for forces
  const double residual = rounding_residual(examined.problem);
  if (residual < poor) return;
  examined.add(
      Severity::warning,
      "the shell is very thin for double precision on the finest mesh: where it bends, rounding alone "
      "may spoil about {:.1g} of forces and energy, and the certificate may call the result inaccurate; take fewer "
      "refinements, a lower degree or a thicker shell",
      residual);
}

void check_start_mesh(Examined& examined) {
  const auto& problem = examined.problem;
  const std::string text = meshing::describe(meshing::start_mesh(problem), problem);
  if (!text.empty()) examined.add(Severity::note, "{}", text);
}

}  // namespace plastron::examination
