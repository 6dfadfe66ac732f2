#include <plastron/recovery/resultants.hpp>

#include <plastron/geometry/rotation.hpp>

namespace plastron::recovery {

SurfaceAxes surface_axes(const Vector3d& tangent, const Vector3d& a3, const std::optional<Vector3d>& axis) {
  Vector3d t1 = tangent;
  if (axis) {
    const Vector3d projected = geometry::tangential(*axis, a3);
    if (projected.norm() > parallel_sine * axis->norm()) t1 = projected;
  }
  t1.normalize();
  return {t1, a3.cross(t1), a3};
}

Eigen::Matrix3d shortest_turn(const Vector3d& from, const Vector3d& to) {
  const Eigen::Matrix3d cross = geometry::cross_matrix(from.cross(to));
  return Eigen::Matrix3d::Identity() + cross + cross * cross / (1 + from.dot(to));
}

Eigen::Matrix2d change_of_axes(const SurfaceAxes& from, const SurfaceAxes& to) {
  const Eigen::Matrix3d turn = shortest_turn(from.a3, to.a3);
  const Vector3d t1 = turn * from.t1, t2 = turn * from.t2;
  Eigen::Matrix2d change;
  change << t1.dot(to.t1), t2.dot(to.t1), t1.dot(to.t2), t2.dot(to.t2);
  return change;
}

Vector3d in_other_axes(const Vector3d& tensor, const Eigen::Matrix2d& change) {
  Eigen::Matrix2d t;
  t << tensor[0], tensor[2], tensor[2], tensor[1];
  const Eigen::Matrix2d p = change * t * change.transpose();
  return {p(0, 0), p(1, 1), p(0, 1)};
}

Resultants in_other_axes(const Resultants& resultants, const Eigen::Matrix2d& change) {
  Resultants result;
  result << in_other_axes(Vector3d(resultants.segment<3>(0)), change).transpose(),
      in_other_axes(Vector3d(resultants.segment<3>(3)), change).transpose(),
      (change * resultants.segment<2>(6).transpose()).transpose();
  return result;
}

Resultants in_other_axes_transposed(const Resultants& weights, const Eigen::Matrix2d& change) {
  Resultants result, unit = Resultants::Zero();
  for (Eigen::Index k = 0; k < 8; ++k) {
    unit[k] = 1;
    result[k] = weights.dot(in_other_axes(unit, change));
    unit[k] = 0;
  }
  return result;
}

ResultantPoints::ResultantPoints(const assembly::DiscreteShell& discrete, assembly::FieldKind kind,
                                 std::optional<Vector3d> axis)
    : discrete_(discrete), kind_(kind), axis_(std::move(axis)) {
  const mesh::Shape shape = discrete.space().shape();
  const int degree = discrete.space().degree;
  basis_ = element::basis_at(shape, degree, element::resultant_points(shape, degree));
  tied_ = element::tied_interpolation(discrete.shell.tables(), basis_.xi);
}

CellResultants ResultantPoints::operator()(std::size_t cell, const element::CellField& field) const {
  const energy::ShellOperator& shell = discrete_.shell;
  const fem::Cell& where = shell.space().cells[cell];
  const auto count = basis_.xi.size();
  std::vector<geometry::Frame> frames(count);
  std::vector<double> e(count);
  shell.surface().frames(where, basis_.xi, frames);
  const std::vector<Vector3d> tangents = shell.surface().first_tangents(where, basis_.xi, frames);
  const energy::CrossSection& section = shell.section(cell);
  shell.surface().evaluate(section.thickness, where, basis_.xi, e);
  const auto state = discrete_.linearised_at(kind_, cell, field);
  const auto strains = shell.strains_at(cell, field, basis_, tied_, frames, state ? &*state : nullptr);

  CellResultants result{.position = {}, .axes = {}, .values = ResultantRows(static_cast<Eigen::Index>(count), 8)};
  for (std::size_t p = 0; p < count; ++p) {
    const geometry::Frame& frame = frames[p];
    const auto row = strains.row(static_cast<Eigen::Index>(p));
    const shell::Strain<double> strain{row.head<3>(), row.segment<3>(3), row.tail<2>()};
    const auto s = shell::resultants(shell::section_at(section.material, frame, e[p]), strain);
    const SurfaceAxes axes = surface_axes(tangents[p], geometry::surface_normal(frame), axis_);
    Eigen::Matrix2d to_axes;  // T^{ab} a_a a_b in orthonormal axes
    to_axes << frame.a_cov[0].dot(axes.t1), frame.a_cov[1].dot(axes.t1), frame.a_cov[0].dot(axes.t2),
        frame.a_cov[1].dot(axes.t2);
    Resultants contravariant;
    contravariant << s.membrane.transpose(), s.bending.transpose(), s.shear.transpose();
    result.values.row(static_cast<Eigen::Index>(p)) = in_other_axes(contravariant, to_axes);
    result.position.push_back(frame.phi);
    result.axes.push_back(axes);
  }
  return result;
}

}  // namespace plastron::recovery
