#include <plastron/estimation/estimate.hpp>

#include <plastron/finite/tangent.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace plastron::estimation {

namespace {

/// Maps nodal forces to generalised forces on the coordinates.
algebra::Vector on_coordinates(const Solved& solved, algebra::Vector forces) {
  algebra::Vector result(solved.box.load.layout(), solved.box.load.block());
  solved.discrete.coordinates.add_transposed(forces, result);
  return result;
}

algebra::Vector cartesian(const Solved& solved, const algebra::Vector& z) {
  algebra::Vector y(z.layout(), 6);
  solved.discrete.coordinates.to_cartesian(z, y);
  return y;
}

/// A^-1 of forces, with fixed coordinates at 0.
std::optional<algebra::Vector> response(DualSolver& solver, const algebra::Vector& forces) {
  auto found = solver.solve({.load = forces, .fixed = algebra::Vector(forces.layout(), forces.block())});
  return found ? std::optional(std::move(found->z)) : std::nullopt;
}

/// Forces without symmetry or pattern, the same on any number of ranks.
algebra::Vector scattered_forces(const Solved& solved) {
  const auto& points = solved.discrete.points;
  algebra::Vector forces(solved.discrete.space().layout, 6);
  for (std::size_t i = 0; i < static_cast<std::size_t>(forces.layout()->owned); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d x = points[i].x;
      const double wave = 43758.5453 * std::sin(12.9898 * x[0] + 78.233 * x[1] + 37.719 * static_cast<double>(k + 1));
      forces.local()[6 * i + k] = points[i].weight * (wave - std::floor(wave) - 0.5);
    }
  return forces;
}

double largest_eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto count = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), count),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), count - 1), Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[count - 1];
}

/// Applies the geometric stiffness of the membrane forces.
algebra::Vector geometric_forces(const Solved& solved, const algebra::Vector& v) {
  const energy::ShellOperator& shell = solved.discrete.shell;
  algebra::Vector f(shell.space().layout, 6);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    energy::CellStrain stresses = solved.discrete.stresses(c, solved.discrete.strains(c, solved.nodal.y));
    stresses.rightCols<5>().setZero();
    shell.scatter(c, finite::geometric_forces(shell, stresses, shell.gather(c, v)), f);
  }
  f.accumulate_ghosts();
  return f;
}

}  // namespace

// Lanczos steps in the inner product of A. A few steps suffice: many modes lie close to the first.
std::optional<double> buckling(const Solved& solved, algebra::Preconditioner& preconditioner) {
  constexpr std::size_t most_steps = 30, steps_to_see_it = 8, steps_between = 4;
  constexpr double far_from_it = 0.1, settled = 0.02;
  DualSolver solver(solved.box, solved.z, preconditioner);
  std::vector<double> alpha, beta, found;
  algebra::Vector force = on_coordinates(solved, scattered_forces(solved)), last_force(force.layout(), force.block());
  std::optional<algebra::Vector> v = response(solver, force);
  if (!v) return {};
  algebra::Vector last(v->layout(), v->block());
  for (double size = std::sqrt(algebra::dot(*v, force)); size > 0 && found.size() < most_steps;) {
    for (algebra::Vector* each : {&*v, &force})
      for (double& value : each->local()) value /= size;
    algebra::Vector next_force = on_coordinates(solved, geometric_forces(solved, cartesian(solved, *v)));
    for (double& value : next_force.local()) value = -value;
    auto next = response(solver, next_force);
    if (!next) return {};
    alpha.push_back(algebra::dot(*v, next_force));
    for (auto [to, at, before] : {std::tuple(&*next, &*v, &last), std::tuple(&next_force, &force, &last_force)}) {
      algebra::axpy(-alpha.back(), *at, *to);
      if (!beta.empty()) algebra::axpy(-beta.back(), *before, *to);
    }
    found.push_back(largest_eigenvalue(alpha, beta));
    const std::size_t steps = found.size();
    if (steps >= steps_to_see_it &&
        (found.back() < far_from_it || found.back() < (1 + settled) * found[steps - 1 - steps_between]))
      break;
    size = std::sqrt(std::max(0.0, algebra::dot(*next, next_force)));
    beta.push_back(size);
    last = std::exchange(*v, std::move(*next));
    last_force = std::exchange(force, std::move(next_force));
    v->update_ghosts();
  }
  return found.empty() ? 0 : std::max(0.0, found.back());
}

}  // namespace plastron::estimation
