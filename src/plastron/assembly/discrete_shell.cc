#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::assembly {

std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description) {
  ShellOperator shell(std::move(space), std::move(surface), description.thickness, description.material,
                      description.tying);
  auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), description.thickness);
  auto coordinates = nodal_coordinates(shell.space(), shell.surface(), points, description.supports, description.gap);
  auto load = load_vector(shell, description.area_loads, description.edge_loads);
  return std::make_unique<DiscreteShell>(DiscreteShell{std::move(shell), std::move(points), std::move(coordinates),
                                                       std::move(load), description.thickness, description.gap});
}

contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix) {
  const auto& layout = discrete.space().layout;
  algebra::Vector load(layout, 5);
  discrete.coordinates.add_transposed(discrete.load, load);
  // Scratch vectors live as long as the operator: it is applied many times.
  const auto y = std::make_shared<algebra::Vector>(layout, 6), f = std::make_shared<algebra::Vector>(layout, 6);
  const auto apply = [&discrete, y, f](const algebra::Vector& z, algebra::Vector& result) {
    discrete.coordinates.to_cartesian(z, *y);
    discrete.shell.apply(*y, *f);
    result.fill(0);
    discrete.coordinates.add_transposed(*f, result);
  };
  return {.matrix = matrix,
          .apply = apply,
          .load = std::move(load),
          .lower = discrete.coordinates.lower,
          .upper = discrete.coordinates.upper};
}

}  // namespace plastron::assembly
