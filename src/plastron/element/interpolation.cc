#include <plastron/element/interpolation.hpp>

#include <plastron/algebra/assertion.hpp>

namespace plastron::element {

using geometry::Matrix3d;
using geometry::MovingBasis;
using geometry::Vector3d;
using shell::LocalField;

LocalField<double> FieldRows::at(Eigen::Index point) const {
  return {{Vector3d(d1.row(point).head<3>()), Vector3d(d2.row(point).head<3>())},
          Vector3d(value.row(point).tail<3>()),
          {Vector3d(d1.row(point).tail<3>()), Vector3d(d2.row(point).tail<3>())}};
}

FieldRows FieldRows::zero(Eigen::Index points) {
  return {CellField::Zero(points, 6), CellField::Zero(points, 6), CellField::Zero(points, 6)};
}

void FieldRows::add_dual(Eigen::Index point, const LocalField<double>& dual) {
  d1.row(point).head<3>() += dual.du[0];
  d2.row(point).head<3>() += dual.du[1];
  d1.row(point).tail<3>() += dual.dr[0];
  d2.row(point).tail<3>() += dual.dr[1];
  value.row(point).tail<3>() += dual.r;
}

Interpolation::Interpolation(std::shared_ptr<const fem::Space> space, std::shared_ptr<const fem::Surface> surface,
                             const ElementTables& tables, bool is_covariant)
    : space_(std::move(space)), surface_(std::move(surface)), is_covariant_(is_covariant) {
  if (!is_covariant_) return;
  node_bases_.resize(static_cast<std::size_t>(space_->layout->local_size()));
  std::vector<geometry::SurfaceJet> jets(tables.nodes.size());
  for (std::size_t c = 0; c < space_->owned_cells; ++c) {
    surface_->parameter_jets(space_->cells[c], tables.nodes, jets);
    for (std::size_t i = 0; i < jets.size(); ++i) node_bases_[space_->nodes(c)[i]] = geometry::covariant_basis(jets[i]);
  }
}

std::vector<MovingBasis> Interpolation::bases(std::size_t cell, std::span<const Vector2d> xi) const {
  if (!is_covariant_) return {};
  std::vector<geometry::SurfaceJet> in_parameters(xi.size());
  std::vector<geometry::Frame> in_cell(xi.size());
  surface_->parameter_jets(space_->cells[cell], xi, in_parameters);
  surface_->frames(space_->cells[cell], xi, in_cell, false);
  std::vector<MovingBasis> bases(xi.size());
  for (std::size_t p = 0; p < xi.size(); ++p) bases[p] = geometry::moving_basis(in_parameters[p], in_cell[p].a_cov);
  return bases;
}

/// Covariant components u_1 u_2 u_3 r_1 r_2 0 at the nodes.
CellField Interpolation::components(std::size_t cell, const CellField& nodal) const {
  // Bases are known at the nodes of owned cells.
  PLASTRON_ASSERT(cell < space_->owned_cells, cell, space_->owned_cells);
  CellField result(nodal.rows(), 6);
  const auto nodes = space_->nodes(cell);
  for (Eigen::Index i = 0; i < nodal.rows(); ++i) {
    const Matrix3d& covariant = node_bases_[nodes[i]];
    result.row(i).head<3>() = nodal.row(i).head<3>() * covariant;
    result.row(i).tail<3>() = nodal.row(i).tail<3>() * covariant;
    result(i, 5) = 0;
  }
  return result;
}

void Interpolation::to_nodal_forces(std::size_t cell, CellField& forces) const {
  const auto nodes = space_->nodes(cell);
  for (Eigen::Index i = 0; i < forces.rows(); ++i) {
    const Matrix3d& covariant = node_bases_[nodes[i]];
    forces(i, 5) = 0;
    forces.row(i).head<3>() = (forces.row(i).head<3>() * covariant.transpose()).eval();
    forces.row(i).tail<3>() = (forces.row(i).tail<3>() * covariant.transpose()).eval();
  }
}

namespace {

/// Multiplies both vectors of each owned node by the node's matrix.
template <class MatrixAt>
algebra::Vector transformed(const algebra::Vector& y, const MatrixAt& matrix_at) {
  algebra::Vector result = y;
  for (std::size_t i = 0; i < y.owned().size() / 3; ++i)
    Eigen::Map<Vector3d>(result.local().data() + 3 * i) =
        matrix_at(i / 2) * Eigen::Map<const Vector3d>(y.local().data() + 3 * i);
  result.update_ghosts();
  return result;
}

}  // namespace

algebra::Vector Interpolation::interpolated(const algebra::Vector& y) const {
  if (!is_covariant_) return y;
  return transformed(y, [&](std::size_t node) { return Matrix3d(node_bases_[node].transpose()); });
}

algebra::Vector Interpolation::nodal_values(const algebra::Vector& interpolated) const {
  if (!is_covariant_) return interpolated;
  return transformed(interpolated, [&](std::size_t node) { return Matrix3d(node_bases_[node].inverse().transpose()); });
}

FieldRows Interpolation::fields(std::size_t cell, const BasisAt& at, Bases bases, const CellField& nodal) const {
  PLASTRON_ASSERT(nodal.rows() == at.value.cols(), nodal.rows(), at.value.cols());
  PLASTRON_ASSERT(bases.size() == (is_covariant_ ? at.xi.size() : 0), bases.size(), at.xi.size(), is_covariant_);
  if (!is_covariant_) return {at.d1 * nodal, at.d2 * nodal, at.value * nodal};
  const CellField c = components(cell, nodal);
  FieldRows rows{at.d1 * c, at.d2 * c, at.value * c};
  for (Eigen::Index p = 0; p < rows.value.rows(); ++p) {
    const MovingBasis& basis = bases[p];
    for (const int part : {0, 3}) {
      const Eigen::RowVector3d value = rows.value.row(p).segment<3>(part);
      const auto differentiate = [&](CellField& d, int along) {
        d.row(p).segment<3>(part) =
            (d.row(p).segment<3>(part) * basis.a.transpose() + value * basis.da[along].transpose()).eval();
      };
      differentiate(rows.d1, 0);
      differentiate(rows.d2, 1);
      rows.value.row(p).segment<3>(part) = value * basis.a.transpose();
    }
  }
  return rows;
}

void Interpolation::add_forces(std::size_t cell, const BasisAt& at, Bases bases, FieldRows dual,
                               CellField& forces) const {
  if (is_covariant_)
    for (Eigen::Index p = 0; p < dual.value.rows(); ++p) {
      const MovingBasis& basis = bases[p];
      for (const int part : {0, 3}) {
        const Eigen::RowVector3d d1 = dual.d1.row(p).segment<3>(part), d2 = dual.d2.row(p).segment<3>(part),
                                 value = dual.value.row(p).segment<3>(part);
        dual.value.row(p).segment<3>(part) = value * basis.a + d1 * basis.da[0] + d2 * basis.da[1];
        dual.d1.row(p).segment<3>(part) = d1 * basis.a;
        dual.d2.row(p).segment<3>(part) = d2 * basis.a;
      }
    }
  CellField result = at.d1.transpose() * dual.d1;
  result.noalias() += at.d2.transpose() * dual.d2;
  result.noalias() += at.value.transpose() * dual.value;
  if (is_covariant_) to_nodal_forces(cell, result);
  forces += result;
}

void Interpolation::write_row(std::size_t cell, const BasisAt& at, Eigen::Index point, Bases bases,
                              const LocalField<double>& dual, Eigen::Ref<Eigen::RowVectorXd> row) const {
  if (!is_covariant_) {
    for (Eigen::Index i = 0; i < at.value.cols(); ++i) {
      const double n = at.value(point, i), n1 = at.d1(point, i), n2 = at.d2(point, i);
      row.segment<3>(6 * i) = n1 * dual.du[0] + n2 * dual.du[1];
      row.segment<3>(6 * i + 3) = n1 * dual.dr[0] + n2 * dual.dr[1] + n * dual.r;
    }
    return;
  }
  const MovingBasis& basis = bases[point];
  const Vector3d u = basis.da[0].transpose() * dual.du[0] + basis.da[1].transpose() * dual.du[1];
  const Vector3d u1 = basis.a.transpose() * dual.du[0], u2 = basis.a.transpose() * dual.du[1];
  const Vector3d r =
      basis.a.transpose() * dual.r + basis.da[0].transpose() * dual.dr[0] + basis.da[1].transpose() * dual.dr[1];
  const Vector3d r1 = basis.a.transpose() * dual.dr[0], r2 = basis.a.transpose() * dual.dr[1];
  const auto nodes = space_->nodes(cell);
  for (Eigen::Index i = 0; i < at.value.cols(); ++i) {
    const double n = at.value(point, i), n1 = at.d1(point, i), n2 = at.d2(point, i);
    const Matrix3d& covariant = node_bases_[nodes[i]];
    row.segment<3>(6 * i) = covariant * (n1 * u1 + n2 * u2 + n * u);
    row.segment<3>(6 * i + 3) = covariant.leftCols<2>() * (n1 * r1 + n2 * r2 + n * r).head<2>();
  }
}

CellField Interpolation::values(std::size_t cell, const BasisAt& at, const CellField& nodal) const {
  if (!is_covariant_) return at.value * nodal;
  return fields(cell, at, bases(cell, at.xi), nodal).value;
}

CellField Interpolation::forces_of(std::size_t cell, const BasisAt& at, const CellField& forces) const {
  if (!is_covariant_) return at.value.transpose() * forces;
  FieldRows dual = FieldRows::zero(forces.rows());
  dual.value = forces;
  CellField result = CellField::Zero(at.value.cols(), 6);
  add_forces(cell, at, bases(cell, at.xi), std::move(dual), result);
  return result;
}

}  // namespace plastron::element
