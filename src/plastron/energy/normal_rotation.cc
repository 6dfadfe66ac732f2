#include <plastron/energy/normal_rotation.hpp>

#include <plastron/shell/strain.hpp>

#include <Eigen/Cholesky>

#include <cmath>
#include <utility>

namespace plastron::energy {

using Eigen::VectorXd;
using shell::LocalField;

namespace {

/// E e^3 times the area of a quadrature point [N m^3].
double stiffness_at(const QuadraturePoint& p) { return p.young * p.thickness * p.thickness * p.thickness * p.area; }

VectorXd gather_scalar(std::span<const algebra::LocalIndex> nodes, const algebra::Vector& q) {
  VectorXd values(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = q.local()[static_cast<std::size_t>(nodes[i])];
  return values;
}

CellGradient scalar_gradients(const element::BasisAt& basis, const VectorXd& values) {
  CellGradient g(basis.value.rows(), 2);
  g << basis.d1 * values, basis.d2 * values;
  return g;
}

/// Raises the index and multiplies by the area: a^{ab} g_b sqrt(a) weight.
void raise(const ShellOperator& shell, std::size_t cell, CellGradient& g) {
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    const QuadraturePoint p = shell.point(cell, q);
    g.row(q) = p.area * (g.row(q) * p.frame.metric_con).eval();
  }
}

}  // namespace

CellGradient normal_rotation_gradients(const ShellOperator& shell, std::size_t cell, const element::CellField& field) {
  const element::FieldRows rows =
      shell.interpolation().fields(cell, shell.tables().quadrature, shell.quadrature_bases(cell), field);
  CellGradient gradients(rows.value.rows(), 2);
  for (int q = 0; q < shell.tables().points_per_cell(); ++q)
    gradients.row(q) = shell::normal_rotation_gradient(rows.at(q), shell.frame_at(cell, q));
  return gradients;
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

namespace {

class NormalRotationTerm final : public Term {
 public:
  explicit NormalRotationTerm(double factor) : factor_(factor) {}

  bool is_artificial() const override { return true; }
  double energy(const ShellOperator& shell, const algebra::Vector& y) const override {
    return tangency_energy(shell, factor_, y);
  }
  void add_forces(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& f) const override {
    add_normal_rotation_form(shell, factor_, y, f);
  }
  std::optional<RowMatrix> stiffness(const ShellOperator& shell, std::size_t cell) const override {
    const RowMatrix root = scaled_normal_rotation_matrix(shell, cell, factor_);
    return RowMatrix(root.transpose() * root);
  }

 private:
  double factor_;
};

}  // namespace

std::shared_ptr<const Term> normal_rotation_term(double factor) {
  return std::make_shared<const NormalRotationTerm>(factor);
}

void apply_coupling(const ShellOperator& shell, const algebra::Vector& y, algebra::Vector& q) {
  PLASTRON_ASSERT(y.block() == 6 && q.block() == 1, y.block(), q.block());
  q.fill(0);
  shell.kernels().add_coupling(shell.packed(), y.local().data(), q.local().data());
  q.accumulate_ghosts();
  shell.space().continuity.apply_transposed(q);
}

void apply_coupling_transposed(const ShellOperator& shell, algebra::Vector& lambda, algebra::Vector& f) {
  PLASTRON_ASSERT(lambda.block() == 1 && f.block() == 6, lambda.block(), f.block());
  shell.space().continuity.apply(lambda);
  f.fill(0);
  shell.kernels().add_coupling_transposed(shell.packed(), lambda.local().data(), f.local().data());
  f.accumulate_ghosts();
}

algebra::Matrix gradient_matrix(const ShellOperator& shell) {
  const fem::Space& space = shell.space();
  const element::BasisAt& basis = shell.tables().quadrature;
  algebra::Matrix matrix(space.layout, 1, space.continuity.couplings(space.connectivity));
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    RowMatrix k = RowMatrix::Zero(basis.value.cols(), basis.value.cols());
    for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
      const QuadraturePoint p = shell.point(c, q);
      Eigen::Matrix2Xd g(2, basis.value.cols());
      g << basis.d1.row(q), basis.d2.row(q);
      k += p.area * g.transpose() * p.frame.metric_con * g;
    }
    // C' k C from k C, for k is symmetric.
    const RowMatrix half = space.continuity.on_sources(space.nodes(c), std::move(k)).matrix.transpose();
    const auto whole = space.continuity.on_sources(space.nodes(c), half);
    matrix.add(whole.nodes, {whole.matrix.data(), static_cast<std::size_t>(whole.matrix.size())});
  }
  matrix.finish();
  return matrix;
}

double gradient_norm(const ShellOperator& shell, const algebra::Vector& q) {
  double sum = 0;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const CellGradient g = scalar_gradients(shell.tables().quadrature, gather_scalar(shell.space().nodes(c), q));
    CellGradient raised = g;
    raise(shell, c, raised);
    sum += g.cwiseProduct(raised).sum();
  }
  return std::sqrt(algebra::sum_over_ranks(sum, shell.space().layout->comm));
}

}  // namespace plastron::energy
