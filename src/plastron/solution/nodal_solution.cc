#include <plastron/solution/nodal_solution.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/energy/normal_rotation.hpp>

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
  discrete.coordinates.space->constraints.apply_transposed(r);
  return r;
}

double total_pressure(const NodalSolution& solution, std::size_t node) {
  const auto all = solution.pressure.at(node);
  return std::accumulate(all.begin() + 1, all.end(), all[0]);
}

bool touches(const NodalSolution& solution, std::size_t node) {
  return std::ranges::any_of(solution.touching.at(node), [](double t) { return t != 0; });
}

namespace {

/// Returns the largest norm of three components from `first` on.
double largest_vector(const algebra::Vector& y, std::size_t first) {
  double largest = 0;
  for (std::size_t i = first; i + 2 < y.owned().size(); i += 6)
    largest = std::max(largest, std::hypot(y.owned()[i], y.owned()[i + 1], y.owned()[i + 2]));
  return algebra::max_over_ranks(largest, y.layout()->comm);
}

NodalSolution zero_solution(const assembly::DiscreteShell& discrete) {
  const auto& layout = discrete.space().layout;
  const int obstacles = discrete.obstacle_block();
  return {.y = algebra::Vector(layout, 6),
          .pressure = algebra::Vector(layout, obstacles),
          .touching = algebra::Vector(layout, obstacles)};
}

/// Sets the pressures and the contact of the rows for which is_active(row) is true, from the residual (collective).
template <class IsActive>
void set_contact(const assembly::DiscreteShell& discrete, const IsActive& is_active, NodalSolution& solution) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const algebra::Vector r = residual(discrete, solution);
  // The force along a row's coordinate of a bed that touches the same node from the other side.
  const auto force_of_bed = [&](const assembly::ContactRow& row) {
    for (const assembly::ContactRow& other : coordinates.rows_of(row.node))
      if (other.bed > 0 && other.gap_coordinate == row.coordinate && is_active(other))
        return other.gap_scale * other.bed * (discrete.entry(other, solution.y) - other.segment.shift);
    return 0.0;
  };
  for (const assembly::ContactRow& row : coordinates.rows) {
    if (!row.binds || !is_active(row)) continue;
    const auto k = static_cast<std::size_t>(row.obstacle);
    solution.touching.at(row.node)[k] = 1;
    solution.pressure.at(row.node)[k] =
        row.bed > 0 ? row.segment.pressure(discrete.entry(row, solution.y))
                    : (coordinates.basis[row.node].col(row.coordinate).dot(assembly::node_values(r, row.node)) -
                       force_of_bed(row)) /
                          (row.scale * discrete.points[row.node].weight);
  }
  for (algebra::Vector* field : {&solution.touching, &solution.pressure}) {
    field->update_ghosts();
    discrete.space().continuity.apply(*field);
  }
  // Interpolation between touching and free masters gives a fraction: a hanging node either touches or does not.
  for (const constraints::Row& row : discrete.space().continuity.rows())
    for (double& touches : solution.touching.at(static_cast<std::size_t>(row.node))) touches = touches > 0.5 ? 1 : 0;
}

}  // namespace

double largest_displacement(const algebra::Vector& y) { return largest_vector(y, 0); }
double largest_rotation(const algebra::Vector& y) { return largest_vector(y, 3); }

NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const contact::BoxSolution& box) {
  NodalSolution solution = zero_solution(discrete);
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  coordinates.to_cartesian(box.z, solution.y);
  solution.lambda = box.equation_multiplier;
  if (solution.lambda.layout()) {
    solution.lambda.update_ghosts();
    discrete.space().continuity.apply(solution.lambda);
  }
  set_contact(
      discrete,
      [&](const assembly::ContactRow& row) {
        return box.activity[coordinates.at(row.node, row.coordinate)] == bound_of(row);
      },
      solution);
  return solution;
}

NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const algebra::Vector& touching) {
  NodalSolution solution = zero_solution(discrete);
  solution.y = discrete.state.displacement;
  set_contact(
      discrete,
      [&](const assembly::ContactRow& row) {
        return touching.at(row.node)[static_cast<std::size_t>(row.obstacle)] > 0.5;
      },
      solution);
  return solution;
}

}  // namespace plastron::solution
