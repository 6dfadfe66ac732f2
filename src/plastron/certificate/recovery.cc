#include <plastron/certificate/recovery.hpp>

#include <limits>

namespace plastron::certificate {

namespace {

struct SurfaceAxes {
  Vector3d t1, t2, a3;
};

SurfaceAxes surface_axes(const geometry::SurfaceJet& in_parameters, const Vector3d& a3) {
  const Vector3d t1 = in_parameters.d[0].normalized();
  return {t1, a3.cross(t1), a3};
}

/// Components of a symmetric tensor T^{ab} a_a a_b in the orthonormal axes.
Vector3d physical(const Vector3d& tensor, const Eigen::Matrix2d& to_axes) {
  Eigen::Matrix2d t;
  t << tensor[0], tensor[2], tensor[2], tensor[1];
  const Eigen::Matrix2d p = to_axes * t * to_axes.transpose();
  return {p(0, 0), p(1, 1), p(0, 1)};
}

double smallest_gap(const assembly::DiscreteShell& discrete, const obstacle::ShellPoint& at, const Vector3d& u,
                    const Vector3d& r) {
  double smallest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    smallest = std::fmin(smallest, discrete.gap(k, at)(u, geometry::tangential(r, at.a3)));
  return smallest;
}

}  // namespace

Recovery::Recovery(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                   const std::vector<Eigen::Vector2d>& xi)
    : discrete_(discrete), solution_(solution) {
  const fem::Shape shape = discrete.space().shape();
  const int degree = discrete.space().degree;
  const auto gauss_points = element::resultant_points(shape, degree);
  from_gauss_ = element::resultant_continuation(shape, degree, xi);
  at_points_ = element::basis_at(shape, degree, xi);
  reaction_at_points_ = element::reaction_basis_at(shape, degree, xi);
  at_gauss_ = element::basis_at(shape, degree, gauss_points);
  tied_at_gauss_ = element::tied_interpolation(discrete.shell.tables(), gauss_points);
}

Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor> Recovery::resultants_at_gauss_points(
    std::size_t cell, const element::CellField& field) const {
  const assembly::ShellOperator& shell = discrete_.shell;
  const fem::Cell& where = shell.space().cells[cell];
  const auto count = at_gauss_.xi.size();
  std::vector<geometry::SurfaceJet> jets(count), in_parameters(count);
  std::vector<double> x(count), y(count), e(count);
  shell.surface().jets(where, at_gauss_.xi, jets);
  shell.surface().parameter_jets(where, at_gauss_.xi, in_parameters);
  shell.surface().positions(where, at_gauss_.xi, x, y);
  const assembly::CrossSection& section = shell.section(cell);
  section.thickness.evaluate(x, y, e);
  const auto strains = shell.strains_at(cell, field, at_gauss_, tied_at_gauss_, jets);

  Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor> result(static_cast<Eigen::Index>(count), 8);
  for (std::size_t p = 0; p < count; ++p) {
    const geometry::Frame frame = geometry::frame_at(jets[p]);
    const auto row = strains.row(static_cast<Eigen::Index>(p));
    const shell::Strain<double> strain{row.head<3>(), row.segment<3>(3), row.tail<2>()};
    const auto stiffness = shell::section_stiffness(section.material, e[p], frame.metric_con);
    const auto s = shell::resultants(stiffness, strain);
    const SurfaceAxes axes = surface_axes(in_parameters[p], frame.a3);
    Eigen::Matrix2d to_axes;
    to_axes << frame.a_cov[0].dot(axes.t1), frame.a_cov[1].dot(axes.t1), frame.a_cov[0].dot(axes.t2),
        frame.a_cov[1].dot(axes.t2);
    result.row(static_cast<Eigen::Index>(p)) << physical(s.membrane, to_axes).transpose(),
        physical(s.bending, to_axes).transpose(), (to_axes * s.shear).transpose();
  }
  return result;
}

std::vector<PointValues> Recovery::operator()(std::size_t cell) const {
  const assembly::ShellOperator& shell = discrete_.shell;
  const fem::Cell& where = shell.space().cells[cell];
  const auto count = at_points_.xi.size();
  std::vector<geometry::SurfaceJet> jets(count);
  std::vector<double> x(count), y(count), e(count);
  shell.surface().parameter_jets(where, at_points_.xi, jets);
  shell.surface().positions(where, at_points_.xi, x, y);
  shell.section(cell).thickness.evaluate(x, y, e);

  const element::CellField field = shell.gather(cell, solution_.y);
  const auto nodes = shell.space().nodes(cell);
  Eigen::MatrixX2d contact(static_cast<Eigen::Index>(nodes.size()), 2);
  Eigen::VectorXd lambda(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = static_cast<std::size_t>(nodes[i]);
    contact.row(static_cast<Eigen::Index>(i)) << total_pressure(solution_, node), touches(solution_, node) ? 1 : 0;
    lambda[static_cast<Eigen::Index>(i)] = solution_.lambda.layout() ? solution_.lambda.local()[node] : 0;
  }
  const element::CellField values = shell.interpolation().values(cell, at_points_, field);
  const element::CellField moved = discrete_.state_values(cell, at_points_);
  const Eigen::MatrixX2d contact_values = reaction_at_points_ * contact;
  const Eigen::VectorXd lambda_values = at_points_.value * lambda;
  const Eigen::MatrixXd resultants = from_gauss_ * resultants_at_gauss_points(cell, field);

  std::vector<PointValues> points(count);
  for (std::size_t p = 0; p < count; ++p) {
    const auto row = static_cast<Eigen::Index>(p);
    const SurfaceAxes axes = surface_axes(jets[p], geometry::unit_normal(jets[p]));
    const Vector3d u = values.row(row).head<3>(), r = values.row(row).tail<3>();
    points[p] = {.x = {x[p], y[p]},
                 .phi = jets[p].value,
                 .t1 = axes.t1,
                 .t2 = axes.t2,
                 .a3 = axes.a3,
                 .thickness = e[p],
                 .u = u,
                 .r = r,
                 .gap = smallest_gap(
                     discrete_, assembly::shell_point(jets[p].value, axes.a3, e[p], moved.row(row).transpose()), u, r),
                 .pressure = contact_values(row, 0),
                 .lambda = lambda_values[row],
                 .touching = contact_values(row, 1),
                 .N = resultants.row(row).segment<3>(0),
                 .M = resultants.row(row).segment<3>(3),
                 .Q = resultants.row(row).segment<2>(6)};
  }
  return points;
}

}  // namespace plastron::certificate
