#include <plastron/recovery/resultants.hpp>

namespace plastron::recovery {

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
  const assembly::ShellOperator& shell = discrete_.shell;
  const fem::Cell& where = shell.space().cells[cell];
  const auto count = basis_.xi.size();
  std::vector<geometry::Frame> frames(count);
  std::vector<double> e(count);
  shell.surface().frames(where, basis_.xi, frames);
  const std::vector<Vector3d> tangents = shell.surface().first_tangents(where, basis_.xi, frames);
  const assembly::CrossSection& section = shell.section(cell);
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
