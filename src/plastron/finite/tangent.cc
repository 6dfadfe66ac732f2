#include <plastron/algebra/agreement.hpp>
#include <plastron/energy/follower_pressure.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/finite/motion_curvature.hpp>
#include <plastron/finite/scalar_blocks.hpp>
#include <plastron/finite/tangent.hpp>
#include <plastron/obstacle/error.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace plastron::finite {

using assembly::RowMatrix;
using Eigen::Vector3d;
using energy::ShellOperator;

namespace {

/// Returns sum over points of s_11 a_1 b_1 + s_22 a_2 b_2 + s_12 (a_1 b_2 + a_2 b_1), by nodes.
Eigen::MatrixXd of_gradients(const element::BasisAt& basis, const Eigen::Ref<const Eigen::MatrixX3d>& s) {
  return weighted_product(basis.d1, s.col(0), basis.d1) + weighted_product(basis.d2, s.col(1), basis.d2) +
         weighted_product(basis.d1, s.col(2), basis.d2) + weighted_product(basis.d2, s.col(2), basis.d1);
}

/// Returns the sampling of the membrane strain 12, at k x k points where strains are tied.
const element::Sampling& sampling_of_12(const element::ElementTables& tables) {
  return *std::ranges::find_if(tables.samplings, [](const element::Sampling& sampling) {
    return std::ranges::find(sampling.membrane, 2) != sampling.membrane.end();
  });
}

/// Returns membrane forces with the negative principal values of N alone, in the coordinates of the cell.
Eigen::Vector3d compression(const Eigen::Vector3d& n) {
  Eigen::Matrix2d both;
  both << n[0], n[2], n[2], n[1];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(both);
  const Eigen::Matrix2d negative =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMin(0).asDiagonal() * eigen.eigenvectors().transpose();
  return {negative(0, 0), negative(1, 1), negative(0, 1)};
}

/// Returns stresses at the sampling points, so that their sum with sampled strains is that with the tied strains.
Eigen::MatrixXd at_samples(const element::Sampling& sampling, const Eigen::MatrixXd& stresses) {
  Eigen::MatrixXd sampled = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(sampling.basis.xi.size()), stresses.cols());
  for (Eigen::Index q = 0; q < stresses.rows(); ++q)
    for (const auto& [t, weight] : sampling.to_quadrature[static_cast<std::size_t>(q)])
      sampled.row(t) += weight * stresses.row(q);
  return sampled;
}

/// Returns the geometric stiffness, tied like the strains; but compressive N, and M, work at the points of the strain 12. At other
/// points they feel motions P_k(xi_2) f(xi_1), which the tied strain 12 does not see: where a cell is narrow, and compressed or
/// strongly bent, these would lower the energy (docs/methods/finite-rotations.md). `is_exact`: the derivative of the residual.
ScalarBlocks geometric_stiffness(const ShellOperator& shell, const CellStrain& stresses, bool is_exact) {
  const element::ElementTables& tables = shell.tables();
  CellStrain others = stresses;
  Eigen::MatrixX3d compressive = Eigen::MatrixX3d::Zero(stresses.rows(), 3);
  for (Eigen::Index q = 0; !is_exact && q < stresses.rows(); ++q) {
    compressive.row(q) = compression(stresses.row(q).head<3>().transpose()).transpose();
    others.row(q).head<3>() -= compressive.row(q);
  }
  ScalarBlocks k = zero_blocks(tables.nodes_per_cell());
  for (std::size_t s = 0; s < tables.samplings.size(); ++s) {
    const element::BasisAt& basis = tables.samplings[s].basis;
    const ShellOperator::SampledStrain sampled = shell.sampled_stresses(s, others);
    k.of_u += of_gradients(basis, sampled.leftCols<3>());
    k.of_u_and_r += weighted_product(basis.d1, sampled.col(3), basis.value) +
                    weighted_product(basis.d2, sampled.col(4), basis.value);
  }
  const element::Sampling& sampling = sampling_of_12(tables);
  k.of_u += of_gradients(sampling.basis, at_samples(sampling, compressive));
  const Eigen::MatrixX3d moments = stresses.middleCols<3>(3);
  k.of_u_and_r +=
      is_exact ? of_gradients(tables.quadrature, moments) : of_gradients(sampling.basis, at_samples(sampling, moments));
  return k;
}

/// Returns the stiffness of a cell by stresses and by pressure that follows it.
constraints::NodeColumns stiffness_by_forces(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                                             const assembly::NodalCoordinates& coordinates, std::size_t cell,
                                             const energy::CellGeometry& at) {
  constraints::NodeColumns k = in_coordinates(
      coordinates, cell, geometric_stiffness(discrete.shell, prestress.stresses[cell], prestress.is_exact));
  const Eigen::VectorXd pressure = discrete.follower_pressure(cell);
  if (pressure.size() > 0)
    k.matrix += on_both_sides(coordinates, coordinates.space->nodes(cell),
                              energy::follower_stiffness(discrete.shell, pressure, at))
                    .matrix;
  return k;
}

/// Returns the derivative of the energy less all forces but those on rigid bodies, at the nodes: Cartesian forces and couples.
algebra::Vector unbalanced_forces(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                                  const fem::Space& space) {
  algebra::Vector forces = assembly::forces_of_stresses(
      discrete.shell, [&](std::size_t c) { return prestress.stresses[c]; },
      [&](std::size_t c) { return discrete.geometry(c); });
  algebra::axpy(1, prestress.forces_of_terms, forces);
  algebra::axpy(-1, discrete.load, forces);
  algebra::axpy(-1, prestress.contact_forces, forces);
  for (const fem::PlacedBody& placed : space.bodies) {
    algebra::Vector on_body(forces.layout(), 6);
    fem::add_body_load(space, placed, on_body);
    algebra::axpy(discrete.state.factors.load(placed.body.factor), on_body, forces);
  }
  return forces;
}

/// Adds the curvature of constrained motions to the stiffness of the cells, `of_cell`. The matrix is not finished.
template <class OfCell>
algebra::Matrix with_curvature(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                               const assembly::NodalCoordinates& coordinates, const OfCell& of_cell) {
  algebra::Matrix matrix = assembly::sum_over_cells(*coordinates.space, coordinates.width, of_cell);
  add_curvature_of_motions(discrete, unbalanced_forces(discrete, prestress, *coordinates.space), coordinates, matrix);
  return matrix;
}

}  // namespace

void add_contact_force(double force, const obstacle::Gap& gap, std::size_t node, algebra::Vector& forces) {
  Eigen::Map<Vector3d>(forces.at(node).data()) += force * gap.normal;
  Eigen::Map<Vector3d>(forces.at(node).data() + 3) += force * gap.arm * gap.normal;
}

Prestress no_prestress(const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  return {.stresses = {space.owned_cells, CellStrain(CellStrain::Zero(discrete.shell.tables().points_per_cell(), 8))},
          .contact_forces = algebra::Vector(space.layout, 6),
          .forces_of_terms = algebra::Vector(space.layout, 6)};
}

Prestress prestress(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  Prestress result;
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    result.stresses.push_back(discrete.stresses(c, discrete.strains(c, solution.y)));
  result.contact_forces = algebra::Vector(discrete.space().layout, 6);
  result.forces_of_terms = forces_of_terms(discrete, solution.y, false);
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    add_contact_force(solution.pressure.at(row.node)[k] * discrete.points[row.node].weight,
                      discrete.coordinates.gaps[k][row.node], row.node, result.contact_forces);
  }
  return result;
}

element::CellField geometric_forces(const ShellOperator& shell, const CellStrain& stresses,
                                    const element::CellField& field) {
  const ScalarBlocks k = geometric_stiffness(shell, stresses, false);
  element::CellField forces(field.rows(), 6);
  forces.leftCols<3>() = k.of_u * field.leftCols<3>() + k.of_u_and_r * field.rightCols<3>();
  forces.rightCols<3>() = k.of_u_and_r.transpose() * field.leftCols<3>();
  return forces;
}

algebra::Matrix material_matrix(const assembly::DiscreteShell& discrete,
                                const assembly::NodalCoordinates& coordinates) {
  algebra::Matrix matrix = assembly::sum_over_cells(*coordinates.space, coordinates.width, [&](std::size_t c) {
    return assembly::material_stiffness(discrete, coordinates, c, discrete.geometry(c));
  });
  add_springs(discrete, coordinates, matrix);
  matrix.finish();
  return matrix;
}

algebra::Matrix geometric_matrix(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                                 const assembly::NodalCoordinates& coordinates) {
  algebra::Matrix matrix = with_curvature(discrete, prestress, coordinates, [&](std::size_t c) {
    return stiffness_by_forces(discrete, prestress, coordinates, c, discrete.geometry(c));
  });
  matrix.finish();
  return matrix;
}

algebra::Matrix tangent_matrix(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                               const assembly::NodalCoordinates& coordinates) {
  algebra::Matrix matrix = with_curvature(discrete, prestress, coordinates, [&](std::size_t c) {
    const energy::CellGeometry at = discrete.geometry(c);
    constraints::NodeColumns k = assembly::material_stiffness(discrete, coordinates, c, at);
    k.matrix += stiffness_by_forces(discrete, prestress, coordinates, c, at).matrix;
    return k;
  });
  add_springs(discrete, coordinates, matrix);
  matrix.finish();
  return matrix;
}

void multiply_through_strains(const assembly::DiscreteShell& discrete, const algebra::Matrix& geometric,
                              const algebra::Vector& z, algebra::Vector& f) {
  const ShellOperator& shell = discrete.shell;
  algebra::Vector y(z.layout(), 6);
  discrete.coordinates.to_cartesian(z, y);
  y.update_ghosts();
  algebra::Vector forces = assembly::forces_of_stresses(
      shell,
      [&](std::size_t c) {
        return shell.weighted_stresses(c, shell.strains(c, shell.gather(c, y), discrete.geometry(c)));
      },
      [&](std::size_t c) { return discrete.geometry(c); });
  add_product_of_terms(discrete, y, forces);
  geometric.multiply(z, f);
  discrete.coordinates.add_transposed(forces, f);
  discrete.coordinates.add_bed_forces(z, f);
}

void add_curvature_of_obstacles(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                                algebra::Matrix& matrix) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const auto width = static_cast<Eigen::Index>(coordinates.width);
  // An obstacle may have no curvature in a place that only one rank sees.
  algebra::in_agreement<obstacle::ObstacleError>(discrete.space().layout->comm, [&] {
    for (const assembly::ContactRow& row : coordinates.rows) {
      const auto k = static_cast<std::size_t>(row.obstacle);
      if (!row.binds || solution.touching.at(row.node)[k] == 0) continue;
      const obstacle::Gap& gap = coordinates.gaps[k][row.node];
      Eigen::Matrix3d curvature = discrete.obstacles.now(k).nearest(gap.contact_point).curvature;
      const double sharpest = 2 / discrete.points[row.node].thickness, sharpness = curvature.norm();
      if (!(sharpness <= sharpest)) curvature *= sharpest / sharpness;
      const RowMatrix basis = coordinates.basis[row.node].leftCols(width);
      const RowMatrix face = basis.topRows<3>() + gap.arm * basis.bottomRows<3>();
      const double force = solution.pressure.at(row.node)[k] * discrete.points[row.node].weight;
      const RowMatrix block = -force * face.transpose() * curvature * face;
      const auto node = static_cast<algebra::LocalIndex>(row.node);
      matrix.add({&node, 1}, {block.data(), static_cast<std::size_t>(block.size())});
    }
  });
  matrix.finish();
}

algebra::Matrix hessian(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                        const assembly::NodalCoordinates& coordinates) {
  algebra::Matrix matrix = tangent_matrix(discrete, prestress(discrete, solution), coordinates);
  add_curvature_of_obstacles(discrete, solution, matrix);
  return matrix;
}

algebra::Matrix derivative_at(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  return discrete.has_increments() ? hessian(discrete, solution, discrete.coordinates) : stiffness_matrix(discrete);
}

}  // namespace plastron::finite
