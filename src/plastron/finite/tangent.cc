#include <plastron/finite/scalar_blocks.hpp>
#include <plastron/finite/tangent.hpp>

namespace plastron::finite {

using assembly::RowMatrix;
using assembly::ShellOperator;
using Eigen::Vector3d;

namespace {

/// Returns sum over points of s_11 a_1 b_1 + s_22 a_2 b_2 + s_12 (a_1 b_2 + a_2 b_1), by nodes.
Eigen::MatrixXd of_gradients(const element::BasisAt& basis, const Eigen::Ref<const Eigen::MatrixX3d>& s) {
  return weighted_product(basis.d1, s.col(0), basis.d1) + weighted_product(basis.d2, s.col(1), basis.d2) +
         weighted_product(basis.d1, s.col(2), basis.d2) + weighted_product(basis.d2, s.col(2), basis.d1);
}

ScalarBlocks geometric_stiffness(const ShellOperator& shell, const CellStrain& stresses) {
  const element::ElementTables& tables = shell.tables();
  ScalarBlocks k = zero_blocks(tables.nodes_per_cell());
  k.of_u_and_r = of_gradients(tables.quadrature, stresses.middleCols<3>(3));
  for (std::size_t s = 0; s < tables.samplings.size(); ++s) {
    const element::BasisAt& basis = tables.samplings[s].basis;
    const ShellOperator::SampledStrain sampled = shell.sampled_stresses(s, stresses);
    k.of_u += of_gradients(basis, sampled.leftCols<3>());
    k.of_u_and_r += weighted_product(basis.d1, sampled.col(3), basis.value) +
                    weighted_product(basis.d2, sampled.col(4), basis.value);
  }
  return k;
}

/// Adds the curvature of the spheres of directors: -(f_i . d_i) s_i . t_i, f_i the couple of all forces on r.
void add_curvature_of_spheres(const assembly::DiscreteShell& discrete, const algebra::Vector& forces,
                              const Prestress& prestress, const assembly::NodalCoordinates& coordinates,
                              algebra::Matrix& matrix) {
  const auto width = static_cast<Eigen::Index>(coordinates.width);
  for (std::size_t i = 0; i < static_cast<std::size_t>(forces.layout()->owned); ++i) {
    if (coordinates.space->constraints.constrains(i)) continue;
    const Vector3d couple = assembly::node_values(forces, i).tail<3>();
    const RowMatrix turn = coordinates.basis[i].bottomRows<3>().leftCols(width);
    const RowMatrix k = (prestress.contact_couples[i] - couple.dot(discrete.place(i).a3)) * turn.transpose() * turn;
    const auto node = static_cast<algebra::LocalIndex>(i);
    matrix.add({&node, 1}, {k.data(), static_cast<std::size_t>(k.size())});
  }
}

/// Returns (u, r) at which strains are linearised.
algebra::Vector linearised_at(const assembly::DiscreteShell& discrete) {
  return discrete.has_finite_rotations() && discrete.state.is_deformed() ? discrete.state.displacement
                                                                         : algebra::Vector(discrete.space().layout, 6);
}

/// Adds the curvature of the spheres to the stiffness of the cells, `of_cell`.
template <class OfCell>
algebra::Matrix with_curvature(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                               const assembly::NodalCoordinates& coordinates, const OfCell& of_cell) {
  algebra::Matrix matrix = assembly::matrix_of_cells(discrete.space(), coordinates.width, of_cell);
  algebra::Vector forces =
      forces_of_stresses(discrete.shell, linearised_at(discrete), [&](std::size_t c) { return prestress.stresses[c]; });
  algebra::axpy(-1, discrete.load, forces);
  if (!discrete.has_finite_rotations())
    algebra::axpy(discrete.state.load_factor, assembly::initial_forces(discrete.shell), forces);
  coordinates.space->constraints.apply_transposed(forces);
  add_curvature_of_spheres(discrete, forces, prestress, coordinates, matrix);
  matrix.finish();
  return matrix;
}

}  // namespace

Prestress prestress(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  Prestress result;
  for (std::size_t c = 0; c < discrete.space().owned_cells; ++c)
    result.stresses.push_back(discrete.stresses(c, discrete.strains(c, solution.y)));
  result.contact_couples.assign(static_cast<std::size_t>(discrete.space().layout->owned), 0);
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    const auto k = static_cast<std::size_t>(row.obstacle);
    const obstacle::Gap& gap = discrete.coordinates.gaps[k][row.node];
    result.contact_couples[row.node] += solution.pressure.at(row.node)[k] * discrete.points[row.node].weight * gap.arm *
                                        gap.normal.dot(discrete.place(row.node).a3);
  }
  return result;
}

element::CellField geometric_forces(const ShellOperator& shell, const CellStrain& stresses,
                                    const element::CellField& field) {
  const ScalarBlocks k = geometric_stiffness(shell, stresses);
  element::CellField forces(field.rows(), 6);
  forces.leftCols<3>() = k.of_u * field.leftCols<3>() + k.of_u_and_r * field.rightCols<3>();
  forces.rightCols<3>() = k.of_u_and_r.transpose() * field.leftCols<3>();
  return forces;
}

algebra::Matrix material_matrix(const assembly::DiscreteShell& discrete,
                                const assembly::NodalCoordinates& coordinates) {
  const ShellOperator& shell = discrete.shell;
  const algebra::Vector y = linearised_at(discrete);
  return assembly::matrix_of_cells(discrete.space(), coordinates.width, [&](std::size_t c) {
    return assembly::material_stiffness(shell, coordinates, c, shell.geometry(c, shell.gather(c, y)));
  });
}

algebra::Matrix geometric_matrix(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                                 const assembly::NodalCoordinates& coordinates) {
  return with_curvature(discrete, prestress, coordinates, [&](std::size_t c) {
    return in_coordinates(coordinates, c, geometric_stiffness(discrete.shell, prestress.stresses[c]));
  });
}

algebra::Matrix tangent_matrix(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                               const assembly::NodalCoordinates& coordinates) {
  const ShellOperator& shell = discrete.shell;
  const algebra::Vector y = linearised_at(discrete);
  return with_curvature(discrete, prestress, coordinates, [&](std::size_t c) {
    constraints::NodeColumns k =
        assembly::material_stiffness(shell, coordinates, c, shell.geometry(c, shell.gather(c, y)));
    k.matrix += in_coordinates(coordinates, c, geometric_stiffness(shell, prestress.stresses[c])).matrix;
    return k;
  });
}

}  // namespace plastron::finite
