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
void add_curvature_of_spheres(const algebra::Vector& forces, const State& state,
                              const std::vector<assembly::NodalPoint>& points,
                              const assembly::NodalCoordinates& coordinates, algebra::Matrix& matrix) {
  const auto width = static_cast<Eigen::Index>(coordinates.width);
  for (std::size_t i = 0; i < static_cast<std::size_t>(forces.layout()->owned); ++i) {
    if (coordinates.space->constraints.constrains(i)) continue;
    const Vector3d couple = assembly::node_values(forces, i).tail<3>();
    const RowMatrix turn = coordinates.basis[i].bottomRows<3>().leftCols(width);
    const RowMatrix k = (state.contact_couples[i] - couple.dot(points[i].a3)) * turn.transpose() * turn;
    const auto node = static_cast<algebra::LocalIndex>(i);
    matrix.add({&node, 1}, {k.data(), static_cast<std::size_t>(k.size())});
  }
}

}  // namespace

algebra::Vector with_unit_directors(const assembly::DiscreteShell& discrete, algebra::Vector y,
                                    const std::vector<BodyPlace>& bodies) {
  for (std::size_t i = 0; i < discrete.points.size(); ++i) {
    const Vector3d& a3 = discrete.points[i].a3;
    Eigen::Map<Vector3d> r(y.at(i).data() + 3);
    r = (a3 + r).normalized() - a3;
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const fem::PlacedBody& placed = discrete.space().bodies[k];
    const Eigen::Matrix3d change = bodies[k].turn - Eigen::Matrix3d::Identity();
    for (const auto& [node, motion] : placed.members) {
      const assembly::NodalPoint& point = discrete.points[static_cast<std::size_t>(node)];
      double* values = y.at(static_cast<std::size_t>(node)).data();
      Eigen::Map<Vector3d>{values} = bodies[k].displacement + change * (point.phi - placed.body.reference);
      if (placed.body.turns_normals) Eigen::Map<Vector3d>{values + 3} = change * point.a3;
    }
  }
  discrete.space().continuity.apply(y);
  return y;
}

std::vector<assembly::NodalPoint> moved_points(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  std::vector<assembly::NodalPoint> points = discrete.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const assembly::Vector6 moved = assembly::node_values(y, i);
    points[i].phi += moved.head<3>();
    points[i].a3 = (points[i].a3 + moved.tail<3>()).normalized();
  }
  return points;
}

CellStrain stresses_of(const assembly::DiscreteShell& discrete, std::size_t cell, const CellStrain& strains) {
  CellStrain stresses = discrete.shell.weighted_stresses(cell, strains);
  if (const auto initial = discrete.shell.weighted_initial_stresses(cell))
    stresses -= discrete.state.load_factor * *initial;
  return stresses;
}

algebra::Vector unbalanced_forces(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  return unbalanced_forces(discrete, y, [&](std::size_t c) {
    return stresses_of(discrete, c, discrete.shell.finite_strains(c, discrete.shell.gather(c, y)));
  });
}

element::CellField geometric_forces(const ShellOperator& shell, const CellStrain& stresses,
                                    const element::CellField& field) {
  const ScalarBlocks k = geometric_stiffness(shell, stresses);
  element::CellField forces(field.rows(), 6);
  forces.leftCols<3>() = k.of_u * field.leftCols<3>() + k.of_u_and_r * field.rightCols<3>();
  forces.rightCols<3>() = k.of_u_and_r.transpose() * field.leftCols<3>();
  return forces;
}

namespace {

/// Adds the curvature of the spheres to the stiffness of the cells, `of_cell`.
template <class OfCell>
algebra::Matrix with_curvature(const assembly::DiscreteShell& discrete, const State& state,
                               const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates, const OfCell& of_cell) {
  algebra::Matrix matrix = assembly::matrix_of_cells(discrete.space(), coordinates.width, of_cell);
  algebra::Vector forces = unbalanced_forces(discrete, state.y, [&](std::size_t c) { return state.stresses[c]; });
  coordinates.space->constraints.apply_transposed(forces);
  add_curvature_of_spheres(forces, state, points, coordinates, matrix);
  matrix.finish();
  return matrix;
}

}  // namespace

algebra::Matrix geometric_matrix(const assembly::DiscreteShell& discrete, const State& state,
                                 const std::vector<assembly::NodalPoint>& points,
                                 const assembly::NodalCoordinates& coordinates) {
  return with_curvature(discrete, state, points, coordinates, [&](std::size_t c) {
    return in_coordinates(coordinates, c, geometric_stiffness(discrete.shell, state.stresses[c]));
  });
}

algebra::Matrix tangent_matrix(const assembly::DiscreteShell& discrete, const State& state,
                               const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates) {
  const ShellOperator& shell = discrete.shell;
  return with_curvature(discrete, state, points, coordinates, [&](std::size_t c) {
    constraints::NodeColumns k =
        assembly::material_stiffness(shell, coordinates, c, shell.geometry(c, shell.gather(c, state.y)));
    k.matrix += in_coordinates(coordinates, c, geometric_stiffness(shell, state.stresses[c])).matrix;
    return k;
  });
}

}  // namespace plastron::finite
