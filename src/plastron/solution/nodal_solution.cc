#include <plastron/solution/nodal_solution.hpp>

#include <plastron/assembly/normal_rotation.hpp>
#include <plastron/fem/carried_nodes.hpp>
#include <plastron/fem/ties.hpp>

#include <algorithm>
#include <numeric>

namespace plastron::solution {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 at_node(const algebra::Vector& v, std::size_t node) {
  return Eigen::Map<const Vector6>(v.local().data() + 6 * node);
}

}  // namespace

algebra::Vector residual(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  algebra::Vector r(discrete.space().layout, 6);
  discrete.residual(solution.y, r);
  if (solution.lambda.layout()) {
    algebra::Vector lambda = solution.lambda, f(discrete.space().layout, 6);
    apply_coupling_transposed(discrete.shell, lambda, f);
    algebra::axpy(1, f, r);
  }
  fem::collect(discrete.space(), r);
  fem::hand_back(discrete.space(), r);
  return r;
}

double total_pressure(const NodalSolution& solution, std::size_t node) {
  const auto block = static_cast<std::size_t>(solution.pressure.block());
  const auto all = solution.pressure.local().subspan(node * block, block);
  return std::accumulate(all.begin() + 1, all.end(), all[0]);
}

bool touches(const NodalSolution& solution, std::size_t node) {
  const auto block = static_cast<std::size_t>(solution.touching.block());
  return std::ranges::any_of(solution.touching.local().subspan(node * block, block), [](double t) { return t != 0; });
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
    fem::spread(discrete.space(), solution.lambda);
  }
  const algebra::Vector r = residual(discrete, solution);
  for (const assembly::ContactRow& row : coordinates.rows) {
    if (!row.binds) continue;
    const auto bound = row.scale > 0 ? contact::Activity::at_lower : contact::Activity::at_upper;
    if (box.activity[coordinates.at(row.node, row.coordinate)] != bound) continue;
    const std::size_t at = row.node * static_cast<std::size_t>(obstacles) + static_cast<std::size_t>(row.obstacle);
    solution.touching.local()[at] = 1;
    solution.pressure.local()[at] = coordinates.basis[row.node].col(row.coordinate).dot(at_node(r, row.node)) /
                                    (row.scale * discrete.points[row.node].weight);
  }
  for (algebra::Vector* field : {&solution.touching, &solution.pressure}) {
    field->update_ghosts();
    fem::spread(discrete.space(), *field);
  }
  // Interpolation between touching and free masters gives a fraction: a tied node either touches or does not.
  for (const fem::Tie& tie : discrete.space().ties)
    for (std::size_t k = 0; k < static_cast<std::size_t>(obstacles); ++k) {
      double& touches =
          solution.touching.local()[static_cast<std::size_t>(tie.node) * static_cast<std::size_t>(obstacles) + k];
      touches = touches > 0.5 ? 1 : 0;
    }
  return solution;
}

}  // namespace plastron::solution
