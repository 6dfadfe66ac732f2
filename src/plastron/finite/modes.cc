#include <plastron/finite/modes.hpp>

#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/finite/newton_step.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::finite {

using algebra::Vector;
using assembly::NodalCoordinates;
using assembly::RowMatrix;

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
  for (const assembly::ContactRow& row : motions.coordinates.rows)
    if (row.binds && solution.touching.at(row.node)[static_cast<std::size_t>(row.obstacle)] > 0.5)
      motions.fixed[motions.coordinates.at(row.node, row.coordinate)] = 1;
  return motions;
}

algebra::Matrix linear_stiffness(const assembly::DiscreteShell& discrete, const NodalCoordinates& coordinates) {
  const fem::Space& space = discrete.space();
  algebra::Matrix matrix(space.layout, coordinates.width, space.constraints.couplings(space.connectivity));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const auto [nodes, k] = assembly::material_stiffness(discrete.shell, coordinates, c, discrete.shell.geometry(c));
    matrix.add(nodes, {k.data(), static_cast<std::size_t>(k.size())});
  }
  matrix.finish();
  return matrix;
}

/// Returns the matrix of int rho (e u . v + e^3/12 r . s) dS.
algebra::Matrix mass_matrix(const assembly::DiscreteShell& discrete, const NodalCoordinates& coordinates) {
  const assembly::ShellOperator& shell = discrete.shell;
  const fem::Space& space = discrete.space();
  const Eigen::MatrixXd& value = shell.tables().quadrature.value;
  algebra::Matrix matrix(space.layout, coordinates.width, space.constraints.couplings(space.connectivity));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    Eigen::VectorXd of_u(value.rows()), of_r(value.rows());
    for (Eigen::Index q = 0; q < value.rows(); ++q) {
      const assembly::QuadraturePoint p = shell.point(c, static_cast<int>(q));
      of_u[q] = shell.section(c).density * p.thickness * p.area;
      of_r[q] = of_u[q] * p.thickness * p.thickness / 12;
    }
    const Eigen::MatrixXd u = value.transpose() * of_u.asDiagonal() * value,
                          r = value.transpose() * of_r.asDiagonal() * value;
    RowMatrix m = RowMatrix::Zero(6 * u.rows(), 6 * u.rows());
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      for (Eigen::Index j = 0; j < u.cols(); ++j) {
        m.block<3, 3>(6 * i, 6 * j).diagonal().setConstant(u(i, j));
        m.block<3, 3>(6 * i + 3, 6 * j + 3).diagonal().setConstant(r(i, j));
      }
    const RowMatrix half = in_coordinates(coordinates, c, std::move(m)).matrix;
    const auto [nodes, k] = in_coordinates(coordinates, c, half.transpose());
    matrix.add(nodes, {k.data(), static_cast<std::size_t>(k.size())});
  }
  matrix.finish();
  return matrix;
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

}  // namespace

namespace {

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
  const algebra::Matrix stiffness = linear_stiffness(discrete, motions.coordinates),
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
  constexpr double never = 1e-9;  // reciprocals of factors that are rounding
  Modes modes{.has_solution = pairs.converged};
  for (std::size_t i = 0; i < pairs.values.size(); ++i) {
    if (!(pairs.values[i] > never)) break;
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
