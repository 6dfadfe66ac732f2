#include <research/spectra/field_norms.hpp>

namespace plastron::spectra {

namespace {

/// Returns a^{ab} p_a . p_b for the derivatives p_a of one field at a point.
double squared_gradient(const Eigen::Matrix2d& metric_con, const geometry::Vector3d& p1, const geometry::Vector3d& p2) {
  return metric_con(0, 0) * p1.squaredNorm() + 2 * metric_con(0, 1) * p1.dot(p2) + metric_con(1, 1) * p2.squaredNorm();
}

}  // namespace

SquaredNorms squared_norms(const energy::ShellOperator& shell, const algebra::Vector& y) {
  const element::BasisAt& basis = shell.tables().quadrature;
  SquaredNorms sum;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::FieldRows v = shell.interpolation().fields(c, basis, shell.quadrature_bases(c), shell.gather(c, y));
    for (int q = 0; q < v.value.rows(); ++q) {
      const energy::QuadraturePoint& p = shell.point(c, q);
      const auto& g = p.frame.metric_con;
      sum.u += p.area * v.value.row(q).head<3>().squaredNorm();
      sum.r += p.area * v.value.row(q).tail<3>().squaredNorm();
      sum.grad_u += p.area * squared_gradient(g, v.d1.row(q).head<3>(), v.d2.row(q).head<3>());
      sum.grad_r += p.area * squared_gradient(g, v.d1.row(q).tail<3>(), v.d2.row(q).tail<3>());
    }
  }
  const MPI_Comm comm = shell.space().layout->comm;
  return {.u = algebra::sum_over_ranks(sum.u, comm),
          .grad_u = algebra::sum_over_ranks(sum.grad_u, comm),
          .r = algebra::sum_over_ranks(sum.r, comm),
          .grad_r = algebra::sum_over_ranks(sum.grad_r, comm)};
}

double squared_distance_to_koiter(const energy::ShellOperator& shell, const algebra::Vector& y) {
  double sum = 0;
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const energy::CellStrain strains = shell.strains(c, shell.gather(c, y));
    for (int q = 0; q < strains.rows(); ++q) {
      const energy::QuadraturePoint& p = shell.point(c, q);
      const Eigen::Vector2d twice_delta = strains.row(q).tail<2>();
      sum += p.area * twice_delta.dot(p.frame.metric_con * twice_delta);
    }
  }
  return algebra::sum_over_ranks(sum, shell.space().layout->comm);
}

}  // namespace plastron::spectra
