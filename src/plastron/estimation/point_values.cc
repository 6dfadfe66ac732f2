// Displacements, resultants and stresses at a point of Omega as functionals.
#include <plastron/estimation/derivatives.hpp>

#include <plastron/fem/cell_point.hpp>
#include <plastron/recovery/stress_peak.hpp>

#include <utility>

namespace plastron::estimation {

namespace {

using recovery::Resultants;

/// J(v) = f . v with f on all nodes; `value` counts on the rank that has the point.
Derivative linear(algebra::Vector f, double value, const Solved& solved) {
  Derivative result = zero_derivative(solved);
  f.accumulate_ghosts();
  solved.discrete.coordinates.add_transposed(f, result.dual.load);
  result.value = algebra::sum_over_ranks(value, solved.discrete.space().layout->comm);
  return result;
}

/// A number computed from the resultants at a point, and its derivative with respect to them.
struct Weighed {
  double value = 0;
  Resultants weights = Resultants::Zero();
};

Weighed weighed(const PointStress& point, const recovery::PointValues& values) {
  const shell::SectionForces forces = recovery::section_forces(values);
  Weighed result;
  if (point.kind == StressKind::resultant) {
    result.weights[point.component] = 1;
    Resultants all;
    all << values.N.transpose(), values.M.transpose(), values.Q.transpose();
    result.value = all[point.component];
  } else if (point.kind == StressKind::von_mises) {
    const auto largest = shell::largest_von_mises(forces);
    result.value = largest.stress;
    result.weights = shell::von_mises_derivative(forces, largest.height).transpose();
  } else {
    const double side = point.kind == StressKind::lower   ? -1
                        : point.kind == StressKind::upper ? 1
                                                          : 0,
                 e = forces.thickness;
    result.weights[point.component] = 1 / e;
    result.weights[3 + point.component] = 6 * side / (e * e);
    result.value = shell::in_plane_stress(forces, side * e / 2)[point.component];
  }
  return result;
}

/// Forces on the nodes of a cell with f . y = weights . resultants of this cell alone, continued to a point.
element::CellField forces_of_cell(const fem::CellPoint& place, const recovery::PointValues& at,
                                  const Resultants& weights, const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  const recovery::ResultantPoints take(discrete, assembly::FieldKind::motion);
  const Eigen::MatrixXd continuation = element::resultant_continuation(space.shape(), space.degree, {place.xi});
  const recovery::SurfaceAxes axes{.t1 = at.t1, .t2 = at.t2, .a3 = at.a3};
  element::CellField unit = element::CellField::Zero(space.nodes_per_cell(), 6), forces = unit;
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    unit.data()[i] = 1;
    const recovery::CellResultants all = take(place.cell, unit);
    for (std::size_t p = 0; p < all.axes.size(); ++p) {
      const auto row = static_cast<Eigen::Index>(p);
      forces.data()[i] +=
          continuation(0, row) * weights.dot(recovery::in_other_axes(Resultants(all.values.row(row)),
                                                                     recovery::change_of_axes(all.axes[p], axes)));
    }
    unit.data()[i] = 0;
  }
  return forces;
}

/// Derivative of a number computed from the resultants at a place that one rank has. Values and derivatives are
/// consistent with Recovery.
Derivative at_place(const PointStress& point, const std::optional<fem::CellPoint>& place, const Solved& solved) {
  const assembly::DiscreteShell& discrete = solved.discrete;
  recovery::Choice choice{.axis = point.axis};
  if (point.is_smooth) choice.patches = solved.recovered();
  algebra::Vector f(discrete.space().layout, 6);
  double value = 0;
  std::optional<recovery::ResultantPatches::Weighed> on_patches;
  if (place) {
    const recovery::PointValues at =
        recovery::Recovery(discrete, solved.nodal, {place->xi}, choice)(place->cell).front();
    const Weighed number = weighed(point, at);
    value = number.value;
    if (point.is_smooth && choice.patches->has_patch(place->cell))
      on_patches = {.cell = place->cell,
                    .xi = place->xi,
                    .position = at.phi,
                    .axes = {.t1 = at.t1, .t2 = at.t2, .a3 = at.a3},
                    .weights = number.weights};
    else
      discrete.shell.scatter(place->cell, forces_of_cell(*place, at, number.weights, discrete), f);
  }
  if (point.is_smooth) choice.patches->add_transposed(discrete, on_patches, f);
  return linear(std::move(f), value, solved);
}

}  // namespace

Derivative derivative_of(const PointDisplacement& point, const Solved& solved) {
  const energy::ShellOperator& shell = solved.discrete.shell;
  const fem::Space& space = shell.space();
  const auto place = fem::cell_point(space, point.at);
  algebra::Vector f(space.layout, 6);
  double value = 0;
  if (place) {
    element::CellField unit = element::CellField::Zero(1, 6);
    unit(0, point.component) = 1;
    const element::CellField forces =
        shell.interpolation().forces_of(place->cell, element::basis_at(space.shape(), space.degree, {place->xi}), unit);
    shell.scatter(place->cell, forces, f);
    value = forces.cwiseProduct(shell.gather(place->cell, solved.nodal.y)).sum();
  }
  return linear(std::move(f), value, solved);
}

Derivative derivative_of(const PointStress& point, const Solved& solved) {
  return at_place(point, fem::cell_point(solved.discrete.space(), point.at), solved);
}

// At the largest stress a change of its place is an effect of second order.
Derivative derivative_of(const LargestStress& stress, const Solved& solved) {
  recovery::Choice choice;
  if (stress.is_smooth) choice.patches = solved.recovered();
  const auto peak = recovery::stress_peak(solved.discrete, solved.nodal, choice, solved.singular);
  const int rank = algebra::rank_in(solved.discrete.space().layout->comm);
  std::optional<fem::CellPoint> place;
  if (rank == peak.rank && peak.von_mises > 0) place = fem::CellPoint{peak.cell, peak.xi};
  return at_place({.at = peak.x, .kind = StressKind::von_mises, .is_smooth = stress.is_smooth}, place, solved);
}

}  // namespace plastron::estimation
