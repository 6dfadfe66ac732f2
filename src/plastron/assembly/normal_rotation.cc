#include <plastron/assembly/normal_rotation.hpp>

#include <plastron/shell/strain.hpp>

#include <Eigen/Cholesky>

namespace plastron::assembly {

using shell::LocalField;

namespace {

/// E e^3 times the area of a quadrature point [N m^3].
double stiffness_at(const QuadraturePoint& p) { return p.young * p.thickness * p.thickness * p.thickness * p.area; }

}  // namespace

CellGradient normal_rotation_gradients(const ShellOperator& shell, std::size_t cell, const element::CellField& field) {
  const element::FieldRows rows =
      shell.interpolation().fields(cell, shell.tables().quadrature, shell.quadrature_bases(cell), field);
  CellGradient gradients(rows.value.rows(), 2);
  for (int q = 0; q < shell.tables().points_per_cell(); ++q)
    gradients.row(q) = shell::normal_rotation_gradient(rows.at(q), shell.frame_at(cell, q));
  return gradients;
}

void add_normal_rotation_forces(const ShellOperator& shell, std::size_t cell, const CellGradient& stresses,
                                element::CellField& forces) {
  element::FieldRows dual = element::FieldRows::zero(stresses.rows());
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    LocalField<double> at_point = shell::zero_field();
    shell::add_normal_rotation_dual(stresses.row(q), shell.frame_at(cell, q), at_point);
    dual.add_dual(q, at_point);
  }
  shell.interpolation().add_forces(cell, shell.tables().quadrature, shell.quadrature_bases(cell), std::move(dual),
                                   forces);
}

void add_normal_rotation_form(const ShellOperator& shell, double factor, const algebra::Vector& y, algebra::Vector& f) {
  shell.kernels().add_normal_rotation(shell.packed(), factor, y.local().data(), f.local().data());
}

double tangency_energy(const ShellOperator& shell, double factor, const algebra::Vector& y) {
  double sum = 0;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const CellGradient g = normal_rotation_gradients(shell, c, shell.gather(c, y));
    for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
      const QuadraturePoint p = shell.point(c, q);
      sum += factor / 2 * stiffness_at(p) * g.row(q).dot(g.row(q) * p.frame.metric_con);
    }
  }
  return algebra::sum_over_ranks(sum, shell.space().layout->comm);
}

RowMatrix scaled_normal_rotation_matrix(const ShellOperator& shell, std::size_t cell, double factor) {
  const int columns = 6 * shell.tables().nodes_per_cell();
  RowMatrix matrix(2 * shell.tables().points_per_cell(), columns);
  Eigen::RowVectorXd row(columns);
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const QuadraturePoint p = shell.point(cell, q);
    const Eigen::Matrix2d root = (factor * stiffness_at(p) * p.frame.metric_con).llt().matrixU();
    for (int a = 0; a < 2; ++a) {
      LocalField<double> dual = shell::zero_field();
      shell::add_normal_rotation_dual(root.row(a), p.frame, dual);
      shell.interpolation().write_row(cell, shell.tables().quadrature, q, shell.quadrature_bases(cell), dual, row);
      matrix.row(2 * q + a) = row;
    }
  }
  return matrix;
}

}  // namespace plastron::assembly
