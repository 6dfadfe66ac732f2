#include <plastron/finite/modes.hpp>

#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/finite/newton_step.hpp>
#include <plastron/finite/scalar_blocks.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::finite {

using algebra::Vector;
using assembly::NodalCoordinates;

namespace {

/// Coordinates of small motions about a solution, of which supports and contact fix some.
struct SmallMotions {
  NodalCoordinates coordinates;
  std::vector<char> fixed;
};

SmallMotions small_motions(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  SmallMotions motions{
      .coordinates = nodal_coordinates(
          discrete.shell.space_pointer(), discrete.points,
          node_supports(discrete.space(), discrete.shell.surface(), discrete.points, discrete.supports),
          discrete.obstacles, element::Formulation::tangent, discrete.state),
      .fixed = {}};
  motions.fixed = motions.coordinates.prescribed();
  const auto activity = assembly::likely_activity(motions.coordinates, solution.touching);
  for (std::size_t i = 0; i < activity.size(); ++i)
    if (activity[i] != contact::Activity::free) motions.fixed[i] = 1;
  return motions;
}

/// Returns the matrix of int rho (e u . v + e^3/12 r . s) dS.
algebra::Matrix mass_matrix(const assembly::DiscreteShell& discrete, const NodalCoordinates& coordinates) {
  const assembly::ShellOperator& shell = discrete.shell;
  const Eigen::MatrixXd& value = shell.tables().quadrature.value;
  return assembly::matrix_of_cells(discrete.space(), coordinates.width, [&](std::size_t c) {
    Eigen::VectorXd of_u(value.rows()), of_r(value.rows());
    for (Eigen::Index q = 0; q < value.rows(); ++q) {
      const assembly::QuadraturePoint p = shell.point(c, static_cast<int>(q));
      of_u[q] = shell.section(c).density * p.thickness * p.area;
      of_r[q] = of_u[q] * p.thickness * p.thickness / 12;
    }
    ScalarBlocks mass = zero_blocks(shell.tables().nodes_per_cell());
    mass.of_u = weighted_product(value, of_u, value);
    mass.of_r = weighted_product(value, of_r, value);
    return in_coordinates(coordinates, c, mass);
  });
}

/// Returns (u, r) of a motion, with the largest displacement 1 and the sign that makes the largest component positive.
Vector shape_of(const NodalCoordinates& coordinates, const Vector& z) {
  Vector y(z.layout(), 6);
  coordinates.to_cartesian(z, y);
  const double size = solution::largest_displacement(y);
  double most = 0, least = 0;
  for (std::size_t i = 0; i < y.owned().size(); ++i)
    if (i % 6 < 3) {
      most = std::max(most, y.owned()[i]);
      least = std::min(least, y.owned()[i]);
    }
  most = algebra::max_over_ranks(most, z.layout()->comm);
  least = algebra::min_over_ranks(least, z.layout()->comm);
  const double factor = (most >= -least ? 1 : -1) / (size > 0 ? size : 1);
  for (double& value : y.local()) value *= factor;
  return y;
}

/// Whether stresses leave the stiffness as it is, up to rounding.
bool is_negligible(const algebra::Matrix& geometric, const algebra::Matrix& stiffness) {
  constexpr double rounding = 1e-15;
  const auto size = [](const algebra::Matrix& matrix) {
    Vector ones(matrix.layout(), matrix.block()), sums(ones);
    ones.fill(1);
    matrix.multiply_absolute(ones, sums);
    double largest = 0;
    for (const double sum : sums.owned()) largest = std::max(largest, sum);
    return algebra::max_over_ranks(largest, matrix.layout()->comm);
  };
  return !(size(geometric) > rounding * size(stiffness));
}

}  // namespace

Modes buckling_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count) {
  const SmallMotions motions = small_motions(discrete, solution);
  const algebra::Matrix stiffness = assembly::matrix_of_cells(discrete.space(), motions.coordinates.width,
                                                              [&](std::size_t c) {
                                                                return assembly::material_stiffness(
                                                                    discrete.shell, motions.coordinates, c,
                                                                    discrete.shell.geometry(c));
                                                              }),
                        geometric = geometric_matrix(discrete, prestress_of_linear(discrete, solution), discrete.points,
                                                     motions.coordinates);
  if (is_negligible(geometric, stiffness)) return {.has_solution = true};
  algebra::Factorisation factor(stiffness);
  if (!factor.factorise(motions.fixed)) return {};
  const auto apply = [&](const Vector& x, Vector& y) {
    Vector force(x.layout(), x.block());
    geometric.multiply(x, force);
    for (std::size_t i = 0; i < motions.fixed.size(); ++i) force.owned()[i] = motions.fixed[i] ? 0 : -force.owned()[i];
    factor.solve(force, y);
  };
  const auto inner = [&](const Vector& x, Vector& y) { stiffness.multiply(x, y); };
  constexpr int most_restarts = 100;  // without compression the reciprocals of all factors crowd below 0
  const algebra::Eigenpairs pairs =
      algebra::eigenpairs({.layout = discrete.space().layout,
                           .block = motions.coordinates.width,
                           .apply = apply,
                           .inner_product = inner,
                           .fixed = motions.fixed},
                          algebra::End::largest, {.count = count, .max_restarts = most_restarts});
  constexpr double never = 1e-9;  // reciprocals of factors, relative to the largest, that are rounding
  Modes modes{.has_solution = pairs.converged};
  for (std::size_t i = 0; i < pairs.values.size(); ++i) {
    if (!(pairs.values[i] > 0 && pairs.values[i] > never * pairs.values[0])) break;
    modes.values.push_back(1 / pairs.values[i]);
    modes.shapes.push_back(shape_of(motions.coordinates, pairs.vectors[i]));
  }
  return modes;
}

Modes vibration_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count) {
  const SmallMotions motions = small_motions(discrete, solution);
  const algebra::Matrix stiffness = tangent_matrix(discrete, prestress_of_linear(discrete, solution), discrete.points,
                                                   motions.coordinates),
                        mass = mass_matrix(discrete, motions.coordinates);
  // A shift makes the stiffness of free motions and of unstable solutions positive. The largest ratio of the diagonals is
  // near the largest square of a frequency.
  const Vector k = stiffness.diagonal(), m = mass.diagonal();
  double largest = 0;
  for (std::size_t i = 0; i < k.owned().size(); ++i)
    if (!motions.fixed[i] && m.owned()[i] > 0) largest = std::max(largest, k.owned()[i] / m.owned()[i]);
  largest = algebra::max_over_ranks(largest, discrete.space().layout->comm);
  algebra::Eigenpairs pairs;
  for (double shift = 0; !pairs.converged && shift < largest; shift = shift == 0 ? 1e-12 * largest : 10 * shift)
    pairs = algebra::smallest_eigenpairs(stiffness, mass, motions.fixed, shift, {.count = count});
  Modes modes{.has_solution = pairs.converged, .values = pairs.values};
  for (const Vector& z : pairs.vectors) modes.shapes.push_back(shape_of(motions.coordinates, z));
  return modes;
}

}  // namespace plastron::finite
