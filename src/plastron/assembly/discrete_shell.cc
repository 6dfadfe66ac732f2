#include <plastron/assembly/discrete_shell.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/multiplier.hpp>
#include <plastron/assembly/stiffness.hpp>

#include <algorithm>

namespace plastron::assembly {

namespace {

std::vector<Eigen::Vector2d> support_points(const std::vector<Support>& supports) {
  std::vector<Eigen::Vector2d> points;
  for (const Support& support : supports)
    if (support.point && std::ranges::find(points, *support.point) == points.end()) points.push_back(*support.point);
  return points;
}

}  // namespace

std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description) {
  const element::Formulation formulation = description.tangency.formulation;
  ShellOperator shell(std::move(space), std::move(surface), description.sections, description.tying,
                      formulation == element::Formulation::classical);
  auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), description.sections);
  auto coordinates = nodal_coordinates(shell.space_pointer(), shell.surface(), points, description.supports,
                                       description.obstacles, formulation);
  auto load = load_vector(shell, description.area_loads, description.edge_loads, description.gravity);
  return std::make_unique<DiscreteShell>(DiscreteShell{std::move(shell), std::move(points), std::move(coordinates),
                                                       std::move(load), description.obstacles, description.tangency,
                                                       support_points(description.supports)});
}

double DiscreteShell::tangency_factor() const {
  if (tangency.formulation == element::Formulation::penalised) return 1 / tangency.penalty;
  return tangency.formulation == element::Formulation::mixed ? tangency.stabilisation : 0;
}

void DiscreteShell::apply(const algebra::Vector& y, algebra::Vector& f) const {
  shell.apply(y, f);
  if (tangency_factor() > 0) add_normal_rotation_form(shell, tangency_factor(), y, f);
}

algebra::Matrix stiffness_matrix(const DiscreteShell& discrete) {
  return stiffness_matrix(discrete.shell, discrete.coordinates, discrete.tangency_factor());
}

namespace {

/// b(U, q) = 0 in nodal coordinates. The Schur complement of the multiplier is spectrally close to the matrix of
/// int a^{ab} d_a p d_b q, for s = q a_3 makes b(s, q) exactly that and costs little else.
contact::EqualityConstraints tangency_constraints(const DiscreteShell& discrete) {
  const auto& layout = discrete.space().layout;
  const auto zeros = std::make_shared<const std::vector<char>>(multiplier_zeros(discrete.coordinates, *layout));
  const auto clear = [zeros](algebra::Vector& q) {
    for (std::size_t i = 0; i < zeros->size(); ++i)
      if ((*zeros)[i]) q.owned()[i] = 0;
  };
  struct Gradients {
    explicit Gradients(algebra::Matrix m) : matrix(std::move(m)), factor(matrix) {}
    algebra::Matrix matrix;
    algebra::Factorisation factor;
  };
  const auto gradients = std::make_shared<Gradients>(gradient_matrix(discrete.shell));
  if (!gradients->factor.factorise(*zeros))
    throw SupportError("the mixed formulation needs r . a_3 = 0 somewhere: fix a component of r on a boundary");
  const auto y = std::make_shared<algebra::Vector>(layout, 6);
  return {.multipliers = algebra::Vector(layout, 1),
          .apply =
              [&discrete, y, clear](const algebra::Vector& z, algebra::Vector& q) {
                discrete.coordinates.to_cartesian(z, *y);
                apply_coupling(discrete.shell, *y, q);
                clear(q);
              },
          .apply_transposed =
              [&discrete, y](const algebra::Vector& q, algebra::Vector& z) {
                apply_coupling_transposed(discrete.shell, q, *y);
                z.fill(0);
                discrete.coordinates.add_transposed(*y, z);
              },
          .precondition = [gradients](const algebra::Vector& q, algebra::Vector& p) { gradients->factor.solve(q, p); }};
}

}  // namespace

contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix) {
  const auto& layout = discrete.space().layout;
  algebra::Vector load(layout, discrete.coordinates.width);
  discrete.coordinates.add_transposed(discrete.load, load);
  // Scratch vectors live as long as the operator: it is applied many times.
  const auto y = std::make_shared<algebra::Vector>(layout, 6), f = std::make_shared<algebra::Vector>(layout, 6);
  const auto apply = [&discrete, y, f](const algebra::Vector& z, algebra::Vector& result) {
    discrete.coordinates.to_cartesian(z, *y);
    discrete.apply(*y, *f);
    result.fill(0);
    discrete.coordinates.add_transposed(*f, result);
  };
  contact::BoxProblem problem{.matrix = matrix,
                              .apply = apply,
                              .load = std::move(load),
                              .lower = discrete.coordinates.lower,
                              .upper = discrete.coordinates.upper};
  if (discrete.tangency.formulation == element::Formulation::mixed) problem.equations = tangency_constraints(discrete);
  return problem;
}

}  // namespace plastron::assembly
