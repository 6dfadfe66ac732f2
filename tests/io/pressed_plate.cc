#include <io/pressed_plate.hpp>
#include <plastron/domain/domain.hpp>

namespace plastron::io {

problem::Problem pressed_plate(const PressedPlate& options) {
  using assembly::Direction;
  using assembly::Unknown;
  problem::Problem problem;
  problem.domain = domain::Rectangle{.cells = {options.cells, options.cells}};
  problem.charts.emplace("", geometry::Chart({"2 * x", "y", "0.012"}, {}));
  problem.shell.sections.common.thickness = geometry::Expression(0.02);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1e9, 0.3, 1);
  for (const char* boundary : {"left", "right", "bottom", "top"}) {
    assembly::Support support{.boundary = boundary, .components = {}};
    for (const Unknown unknown : {Unknown::displacement, Unknown::rotation})
      for (const Direction direction : {Direction::x, Direction::y, Direction::z})
        support.components.push_back({.unknown = unknown, .direction = direction});
    problem.shell.supports.push_back(support);
  }
  energy::AreaLoad load;
  load.force[2] = geometry::Expression(-6e3);
  problem.shell.loads.on_areas.push_back(load);
  if (options.obstacle) problem.shell.obstacles.all = {obstacle::Obstacle{}};
  problem.probes.push_back({.name = "centre", .at = {0.5, 0.5}});
  problem.discretisation = {.cells = options.shape, .degree = options.degree, .refinements = options.refinements};
  return problem;
}

}  // namespace plastron::io
