#include <plastron/solution/nodal_solution.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/constraints/map.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plastron::solution {

algebra::Vector residual(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  algebra::Vector r(discrete.space().layout, 6);
  discrete.residual(solution.y, r);
  if (solution.lambda.layout()) {
    algebra::Vector lambda = solution.lambda, f(discrete.space().layout, 6);
    apply_coupling_transposed(discrete.shell, lambda, f);
    algebra::axpy(1, f, r);
  }
  discrete.space().constraints.apply_transposed(r);
  return r;
}

double total_pressure(const NodalSolution& solution, std::size_t node) {
  const auto all = solution.pressure.at(node);
  return std::accumulate(all.begin() + 1, all.end(), all[0]);
}

bool touches(const NodalSolution& solution, std::size_t node) {
  return std::ranges::any_of(solution.touching.at(node), [](double t) { return t != 0; });
}

double largest_displacement(const algebra::Vector& y) {
  double largest = 0;
  for (std::size_t i = 0; i + 2 < y.owned().size(); i += 6)
    largest = std::max(largest, std::hypot(y.owned()[i], y.owned()[i + 1], y.owned()[i + 2]));
  return algebra::max_over_ranks(largest, y.layout()->comm);
}

NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const contact::BoxSolution& box) {
  const auto& layout = discrete.space().layout;
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const int obstacles = std::max(1, static_cast<int>(coordinates.gaps.size()));
  NodalSolution solution{.y = algebra::Vector(layout, 6),
                         .pressure = algebra::Vector(layout, obstacles),
                         .touching = algebra::Vector(layout, obstacles),
                         .lambda = box.equation_multiplier};
  coordinates.to_cartesian(box.z, solution.y);
  if (solution.lambda.layout()) {
    solution.lambda.update_ghosts();
    discrete.space().continuity.apply(solution.lambda);
  }
  const algebra::Vector r = residual(discrete, solution);
  for (const assembly::ContactRow& row : coordinates.rows) {
    if (!row.binds) continue;
    if (box.activity[coordinates.at(row.node, row.coordinate)] != bound_of(row)) continue;
    const auto k = static_cast<std::size_t>(row.obstacle);
    solution.touching.at(row.node)[k] = 1;
    solution.pressure.at(row.node)[k] =
        coordinates.basis[row.node].col(row.coordinate).dot(assembly::node_values(r, row.node)) /
        (row.scale * discrete.points[row.node].weight);
  }
  for (algebra::Vector* field : {&solution.touching, &solution.pressure}) {
    field->update_ghosts();
    discrete.space().continuity.apply(*field);
  }
  // Interpolation between touching and free masters gives a fraction: a hanging node either touches or does not.
  for (const constraints::Row& row : discrete.space().continuity.rows())
    for (double& touches : solution.touching.at(static_cast<std::size_t>(row.node))) touches = touches > 0.5 ? 1 : 0;
  return solution;
}

}  // namespace plastron::solution
