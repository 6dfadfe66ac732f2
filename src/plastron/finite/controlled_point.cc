#include <plastron/finite/controlled_point.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/finite/scalar_blocks.hpp>

#include <algorithm>

namespace plastron::finite {

using assembly::RowMatrix;

ControlledPoint::ControlledPoint(const assembly::DiscreteShell& discrete)
    : discrete_(discrete),
      point_(fem::cell_point(discrete.space(), discrete.state.control->at)),
      row_(discrete.space().layout, discrete.coordinates.width) {
  const fem::Space& space = discrete.space();
  algebra::Vector c(space.layout, 6);
  if (point_) {
    const element::BasisAt at = element::basis_at(space.shape(), space.degree, {point_->xi});
    cell_row_ = Eigen::RowVectorXd::Zero(6 * at.value.cols());
    for (Eigen::Index i = 0; i < at.value.cols(); ++i)
      cell_row_.segment<3>(6 * i) = at.value(0, i) * discrete.state.control->direction.transpose();
    discrete.shell.scatter(point_->cell, Eigen::Map<const element::CellField>(cell_row_.data(), at.value.cols(), 6), c);
  }
  c.accumulate_ghosts();
  discrete.coordinates.add_transposed(c, row_);
}

double ControlledPoint::rest() const {
  double now = 0;
  if (point_) {
    const element::CellField field = discrete_.shell.gather(point_->cell, discrete_.state.displacement);
    now = cell_row_.dot(Eigen::Map<const Eigen::RowVectorXd>(field.data(), field.size()));
  }
  return discrete_.state.control->displacement - algebra::sum_over_ranks(now, discrete_.space().layout->comm);
}

algebra::Vector ControlledPoint::load_rate() const {
  const assembly::DiscreteShell& d = discrete_;
  algebra::Vector rate(d.space().layout, d.coordinates.width);
  algebra::Vector forces = assembly::load_rate(d);
  d.coordinates.add_transposed(forces, rate);
  return rate;
}

double ControlledPoint::stiffness(const algebra::Matrix& matrix) const {
  constexpr double far_above = 10;
  const algebra::Vector diagonal = matrix.diagonal();
  double stiffest = 0, largest = 0;
  for (std::size_t i = 0; i < row_.owned().size(); ++i) {
    const double c = row_.owned()[i];
    if (c == 0) continue;
    stiffest = std::max(stiffest, diagonal.owned()[i]);
    largest = std::max(largest, c * c);
  }
  const MPI_Comm comm = discrete_.space().layout->comm;
  largest = algebra::max_over_ranks(largest, comm);
  return largest > 0 ? far_above * algebra::max_over_ranks(stiffest, comm) / largest : 0;
}

void ControlledPoint::add(double rho, algebra::Matrix& matrix) const {
  if (point_) {
    const constraints::NodeColumns k =
        on_both_sides(discrete_.coordinates, discrete_.coordinates.space->nodes(point_->cell),
                      RowMatrix(rho * cell_row_.transpose() * cell_row_));
    matrix.add(k.nodes, {k.matrix.data(), static_cast<std::size_t>(k.matrix.size())});
  }
  matrix.finish();
}

}  // namespace plastron::finite
