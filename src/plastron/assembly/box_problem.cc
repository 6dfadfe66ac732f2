#include <plastron/assembly/box_problem.hpp>

#include <plastron/algebra/factorisation.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/geometry/frame.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plastron::assembly {

namespace {

/// Multiplies rows from `first` on, in place, by the transpose of the Cholesky factor of a point's stiffness times its
/// area.
template <int size>
void scale_rows(const Eigen::Matrix<double, size, size>& stiffness, double area, Eigen::Index first, RowMatrix& b) {
  const Eigen::Matrix<double, size, size> upper = std::sqrt(area) * stiffness.llt().matrixU().toDenseMatrix();
  for (int i = 0; i < size; ++i) {
    b.row(first + i) *= upper(i, i);
    for (int j = i + 1; j < size; ++j) b.row(first + i) += upper(i, j) * b.row(first + j);
  }
}

/// Computes C' B, where C C' is the weighted section stiffness at each point. The element matrix is then (C' B)'
/// (C' B).
void scale_by_stiffness(const energy::ShellOperator& shell, std::size_t cell, RowMatrix& b) {
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const energy::QuadraturePoint p = shell.point(cell, q);
    if (p.section.is_coupled()) {
      scale_rows(p.section.in_plane(), p.area, 8 * q, b);
    } else {
      scale_rows(p.section.membrane, p.area, 8 * q, b);
      scale_rows(p.section.bending, p.area, 8 * q + 3, b);
    }
    scale_rows(p.section.shear, p.area, 8 * q + 6, b);
  }
}

/// Returns the constraint b(U, q) = 0 in nodal coordinates. The Schur complement of the multiplier is spectrally close
/// to the matrix of int a^{ab} d_a p d_b q. The reason: b(s, q) is equal to this form for s = q a_3, and this s adds
/// little other energy.
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
  const auto y = std::make_shared<algebra::Vector>(layout, 6), spread = std::make_shared<algebra::Vector>(layout, 1);
  return {.multipliers = algebra::Vector(layout, 1),
          .apply =
              [&discrete, y, clear](const algebra::Vector& z, algebra::Vector& q) {
                discrete.coordinates.to_cartesian(z, *y);
                apply_coupling(discrete.shell, *y, q);
                clear(q);
              },
          .apply_transposed =
              [&discrete, y, spread](const algebra::Vector& q, algebra::Vector& z) {
                *spread = q;
                apply_coupling_transposed(discrete.shell, *spread, *y);
                z.fill(0);
                discrete.coordinates.add_transposed(*y, z);
              },
          .precondition = [gradients](const algebra::Vector& q, algebra::Vector& p) { gradients->factor.solve(q, p); }};
}

/// Returns the decrease of a row's gap for a unit motion of its obstacle along the force.
double closing(const NodalCoordinates& coordinates, const RigidObstacles& obstacles, const ContactRow& row) {
  const auto k = static_cast<std::size_t>(row.obstacle);
  return coordinates.gaps[k][row.node].normal.dot(obstacles.all[k].force.normalized());
}

RowMatrix gram(const energy::ShellOperator& shell, const RowMatrix& b) {
  RowMatrix k(b.cols(), b.cols());
  shell.kernels().gram(b.data(), static_cast<int>(b.rows()), static_cast<int>(b.cols()), k.data());
  k.triangularView<Eigen::StrictlyUpper>() = k.transpose();
  return k;
}

}  // namespace

std::vector<char> multiplier_zeros(const NodalCoordinates& coordinates, const algebra::Layout& layout) {
  std::vector<char> zeros(static_cast<std::size_t>(layout.owned));
  for (std::size_t i = 0; i < zeros.size(); ++i)
    zeros[i] = coordinates.is_prescribed(i, NodalCoordinates::normal_rotation);
  return zeros;
}

constraints::NodeColumns material_stiffness(const DiscreteShell& discrete, const NodalCoordinates& coordinates,
                                            std::size_t cell, const energy::CellGeometry& at) {
  const energy::ShellOperator& shell = discrete.shell;
  auto [nodes, b] = in_coordinates(coordinates, coordinates.space->nodes(cell), shell.strain_matrix(cell, at));
  scale_by_stiffness(shell, cell, b);
  constraints::NodeColumns k{std::move(nodes), gram(shell, b)};
  for (const auto& term : discrete.terms)
    if (auto own = term->stiffness(shell, cell))
      k.matrix += on_both_sides(coordinates, coordinates.space->nodes(cell), std::move(*own)).matrix;
  return k;
}

std::vector<contact::PressingForce> pressing_forces(const NodalCoordinates& coordinates,
                                                    const RigidObstacles& obstacles, const State& state) {
  std::vector<contact::PressingForce> forces;
  for (const std::size_t k : pressed_obstacles(obstacles, state)) {
    const algebra::Vector zero(coordinates.lower.layout(), coordinates.width);
    forces.push_back(
        {.lower_shape = zero, .upper_shape = zero, .force = state.factors.force(k) * obstacles.all[k].force.norm()});
    for (const ContactRow& row : coordinates.rows) {
      if (!row.binds || static_cast<std::size_t>(row.obstacle) != k) continue;
      algebra::Vector& shape = row.scale > 0 ? forces.back().lower_shape : forces.back().upper_shape;
      shape.owned()[coordinates.at(row.node, row.coordinate)] = closing(coordinates, obstacles, row) / row.scale;
    }
  }
  return forces;
}

std::vector<contact::Activity> likely_activity(const NodalCoordinates& coordinates, const algebra::Vector& zone) {
  std::vector<contact::Activity> activity(coordinates.lower.owned().size(), contact::Activity::free);
  for (const ContactRow& row : coordinates.rows)
    if (row.binds && zone.at(row.node)[static_cast<std::size_t>(row.obstacle)] > 0.5)
      activity[coordinates.at(row.node, row.coordinate)] = bound_of(row);
  return activity;
}

algebra::Matrix stiffness_matrix(const DiscreteShell& discrete) {
  const energy::ShellOperator& shell = discrete.shell;
  const NodalCoordinates& coordinates = discrete.coordinates;
  algebra::Matrix matrix = sum_over_cells(shell.space(), coordinates.width, [&](std::size_t c) {
    return material_stiffness(discrete, coordinates, c, shell.geometry(c));
  });
  add_springs(discrete, coordinates, matrix);
  matrix.finish();
  return matrix;
}

contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix) {
  const auto& layout = discrete.space().layout;
  algebra::Vector load(layout, discrete.coordinates.width);
  algebra::Vector forces = loads_and_initial_forces(discrete);
  discrete.coordinates.add_transposed(forces, load);
  // Scratch vectors live as long as the operator because it is applied many times.
  const auto y = std::make_shared<algebra::Vector>(layout, 6), f = std::make_shared<algebra::Vector>(layout, 6);
  const auto apply = [&discrete, y, f](const algebra::Vector& z, algebra::Vector& result) {
    discrete.coordinates.to_cartesian(z, *y);
    discrete.apply(*y, *f);
    result.fill(0);
    discrete.coordinates.add_transposed(*f, result);
    discrete.coordinates.add_bed_forces(z, result);
  };
  contact::BoxProblem problem{.matrix = matrix,
                              .apply = apply,
                              .load = std::move(load),
                              .lower = discrete.coordinates.lower,
                              .upper = discrete.coordinates.upper};
  problem.pressing = pressing_forces(discrete.coordinates, discrete.obstacles, discrete.state);
  if (discrete.tangency.formulation == element::Formulation::mixed) problem.equations = tangency_constraints(discrete);
  return problem;
}

std::vector<std::size_t> pressed_obstacles(const RigidObstacles& obstacles, const State& state) {
  std::vector<std::size_t> pressed;
  for (std::size_t k = 0; k < obstacles.all.size(); ++k)
    if (obstacles.all[k].is_pressed() && state.factors.force(k) > 0) pressed.push_back(k);
  return pressed;
}

void press(DiscreteShell& discrete, std::span<const double> ways) {
  NodalCoordinates& coordinates = discrete.coordinates;
  std::vector<double> way(discrete.obstacles.all.size(), 0);
  const auto pressed = pressed_obstacles(discrete);
  PLASTRON_ASSERT(ways.size() == pressed.size(), ways.size(), pressed.size());
  for (std::size_t j = 0; j < pressed.size(); ++j) way[pressed[j]] = ways[j];
  for (ContactRow& row : coordinates.rows) {
    const double closed = way[static_cast<std::size_t>(row.obstacle)] * closing(coordinates, discrete.obstacles, row);
    if (closed == 0) continue;
    row.bound_gap -= closed;
    if (!row.binds) continue;
    algebra::Vector& bounds = row.scale > 0 ? coordinates.lower : coordinates.upper;
    bounds.owned()[coordinates.at(row.node, row.coordinate)] = -row.bound_gap / row.scale;
  }
  coordinates.lower.update_ghosts();
  coordinates.upper.update_ghosts();
  for (const std::size_t k : pressed) {
    const Vector3d by = way[k] * discrete.obstacles.all[k].force.normalized();
    discrete.obstacles.moved[k] += by;
    for (obstacle::Gap& gap : coordinates.gaps[k]) gap.initial -= gap.normal.dot(by);
  }
}

std::optional<double> part_by_beds(const DiscreteShell& discrete, const algebra::Vector& y, const algebra::Vector& way,
                                   std::span<const double> pressed) {
  constexpr int most_halvings = 40;
  constexpr double negligible = 1e-9;
  if (!discrete.obstacles.has_segments()) return {};
  const std::size_t k = discrete.obstacles.on_bed().value();
  const obstacle::Obstacle& body = discrete.obstacles.all[k];
  Vector3d ahead = Vector3d::Zero();
  const auto all_pressed = pressed_obstacles(discrete);
  for (std::size_t j = 0; j < pressed.size(); ++j)
    if (all_pressed[j] == k) ahead = pressed[j] * body.force.normalized();
  struct Closing {
    double area, end, change, pressure;  // closure at the end of the way, its change, and the pressure of the solution
  };
  std::vector<Closing> rows;
  std::int64_t leaving = 0;
  for (const ContactRow& row : discrete.coordinates.rows) {
    if (row.bed == 0) continue;
    const obstacle::Gap& gap = discrete.coordinates.gaps[k][row.node];
    const Vector6 moved = node_values(way, row.node);
    const Vector3d r = geometry::tangential(moved.tail<3>(), discrete.place(row.node).a3);
    const double end = discrete.entry(row, y) + gap.normal.dot(ahead);
    rows.push_back({discrete.points[row.node].weight, end,
                    gap.normal.dot(discrete.obstacles.way(k) + ahead - moved.head<3>() - gap.arm * r),
                    std::max(0.0, row.segment.pressure(end))});
    if (body.bed.segment(end) != row.segment) ++leaving;
  }
  if (algebra::sum_over_ranks(leaving, discrete.space().layout->comm) == 0) return {};
  // The solution is stationary with the pressures of its segments. So the slope is that of the laws less these pressures, and what the
  // shell lacks to its end.
  const double twice_energy = 2 * discrete.motion_energies(way).total();
  const auto slope = [&](double t) {
    double sum = 0;
    for (const Closing& row : rows)
      sum += row.area * (body.bed.pressure(row.end - (1 - t) * row.change) - row.pressure) * row.change;
    return algebra::sum_over_ranks(sum, discrete.space().layout->comm) - (1 - t) * twice_energy;
  };
  const double start = slope(0);
  if (!(start < 0) || slope(1) <= -negligible * start) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < most_halvings; ++i) {
    const double middle = (low + high) / 2;
    (slope(middle) < 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace plastron::assembly
