#include <plastron/recovery/recovery.hpp>

#include <limits>

namespace plastron::recovery {

namespace {

/// Returns the least gap at a point where the fields are `now` and those of the linearisation `state`.
double smallest_gap(const assembly::DiscreteShell& discrete, const PointValues& at, const assembly::Vector6& state,
                    const assembly::Vector6& now) {
  const obstacle::ShellPoint before = discrete.shell_point(at.phi, at.a3, at.thickness, state),
                             here = discrete.shell_point(at.phi, at.a3, at.thickness, now);
  double smallest = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    smallest = std::fmin(smallest, discrete.gap(k, before)(here.u, here.r));
  return smallest;
}

/// Reaction and contact at a node: of all obstacles, and per face.
Eigen::Matrix<double, 1, 6> contact_at(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                       std::size_t node) {
  Eigen::Matrix<double, 1, 6> values = Eigen::Matrix<double, 1, 6>::Zero();
  values[0] = total_pressure(solution, node);
  values[1] = touches(solution, node) ? 1 : 0;
  const auto& gaps = discrete.coordinates.gaps;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const std::size_t at = node * gaps.size() + k;
    const int face = gaps[k][node].z > 0 ? 1 : 0;
    values[2 + face] += solution.pressure.local()[at];
    if (solution.touching.local()[at] != 0) values[4 + face] = 1;
  }
  return values;
}

/// Resultants of one cell alone, continued from its resultant points. All are first transformed to the axes of one
/// point, so that the continued values do not depend on how axes turn in the cell.
class ContinuedResultants {
 public:
  ContinuedResultants(CellResultants at_resultant_points, const Eigen::MatrixXd& continuation)
      : axes_(at_resultant_points.axes.front()) {
    ResultantRows& values = at_resultant_points.values;
    for (std::size_t p = 0; p < at_resultant_points.axes.size(); ++p) {
      auto row = values.row(static_cast<Eigen::Index>(p));
      row = in_other_axes(Resultants(row), change_of_axes(at_resultant_points.axes[p], axes_));
    }
    values_ = continuation * values;
  }
  Resultants at(std::size_t point, const SurfaceAxes& axes) const {
    return in_other_axes(Resultants(values_.row(static_cast<Eigen::Index>(point))), change_of_axes(axes_, axes));
  }

 private:
  SurfaceAxes axes_;
  ResultantRows values_;
};

/// Returns b_11, b_22, 2 b_12 in orthonormal axes.
Vector3d curvature_along(const geometry::Frame& frame, const SurfaceAxes& axes) {
  Eigen::Matrix2d change;
  for (int a = 0; a < 2; ++a) {
    const Vector3d& dual = frame.a_con[static_cast<std::size_t>(a)];
    change.row(a) << dual.dot(axes.t1), dual.dot(axes.t2);
  }
  const Eigen::Matrix2d b = change.transpose() * geometry::curvature(frame) * change;
  return {b(0, 0), b(1, 1), 2 * b(0, 1)};
}

}  // namespace

void set_law(const energy::CrossSection& section, PointValues& point) {
  point.material = section.material;
  if (const auto laminate = section.material.laminate())
    point.laminate =
        std::make_shared<shell::LaminateSection>(laminate, shell::orthonormal_frame(point.t1, point.t2),
                                                 point.thickness, section.material.shear_correction, point.initial);
}

Recovery::Recovery(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                   const std::vector<Eigen::Vector2d>& xi, Choice choice)
    : discrete_(discrete),
      solution_(solution),
      choice_(std::move(choice)),
      resultant_points_(discrete, assembly::FieldKind::solution, choice_.axis) {
  const mesh::Shape shape = discrete.space().shape();
  const int degree = discrete.space().degree;
  at_points_ = element::basis_at(shape, degree, xi);
  continuation_ = element::resultant_continuation(shape, degree, xi);
  reaction_at_points_ = element::reaction_basis_at(shape, degree, xi);
}

std::vector<PointValues> Recovery::geometry_at_points(std::size_t cell) const {
  const energy::ShellOperator& shell = discrete_.shell;
  const fem::Cell& where = shell.space().cells[cell];
  const auto count = at_points_.xi.size();
  std::vector<geometry::Frame> frames(count);
  std::vector<double> x(count), y(count), e(count);
  shell.surface().frames(where, at_points_.xi, frames);
  const std::vector<Vector3d> tangents = shell.surface().first_tangents(where, at_points_.xi, frames);
  shell.surface().positions(where, at_points_.xi, x, y);
  const energy::CrossSection& section = shell.section(cell);
  shell.surface().evaluate(section.thickness, where, at_points_.xi, e);
  const auto initial = shell.initial_states(cell, at_points_.xi, discrete_.state.factors);
  std::vector<PointValues> points(count);
  for (std::size_t p = 0; p < count; ++p) {
    const geometry::Frame& frame = frames[p];
    const SurfaceAxes axes = surface_axes(tangents[p], geometry::surface_normal(frame), choice_.axis);
    const auto curvatures = geometry::principal_curvatures(frame);
    points[p].x = {x[p], y[p]};
    points[p].phi = frame.phi;
    points[p].t1 = axes.t1;
    points[p].t2 = axes.t2;
    points[p].a3 = frame.a3;
    points[p].curvatures = {curvatures[0], curvatures[1]};
    points[p].thickness = e[p];
    points[p].initial = initial[p];
    points[p].initial.curvature = curvature_along(frame, axes);
    set_law(section, points[p]);
  }
  return points;
}

void Recovery::add_nodal_values(std::size_t cell, const element::CellField& field,
                                std::vector<PointValues>& points) const {
  const energy::ShellOperator& shell = discrete_.shell;
  const auto nodes = shell.space().nodes(cell);
  Eigen::Matrix<double, Eigen::Dynamic, 6> contact(static_cast<Eigen::Index>(nodes.size()), 6);
  Eigen::VectorXd lambda(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto node = static_cast<std::size_t>(nodes[i]);
    contact.row(static_cast<Eigen::Index>(i)) = contact_at(discrete_, solution_, node);
    lambda[static_cast<Eigen::Index>(i)] = solution_.lambda.layout() ? solution_.lambda.local()[node] : 0;
  }
  const element::CellField values = shell.interpolation().values(cell, at_points_, field);
  const element::CellField moved = discrete_.state_values(cell, at_points_);
  for (const auto& [foundation, term] : discrete_.foundations) {
    if (!term || !foundation.is_under_area()) continue;
    const std::vector<Vector3d> own = tractions(shell, foundation, cell, at_points_.xi, values);
    for (std::size_t p = 0; p < points.size(); ++p) points[p].carried += own[p];
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 6> contact_values = reaction_at_points_ * contact;
  const Eigen::VectorXd lambda_values = at_points_.value * lambda;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(p);
    PointValues& point = points[p];
    point.u = values.row(row).head<3>();
    point.r = values.row(row).tail<3>();
    point.gap = smallest_gap(discrete_, point, moved.row(row).transpose(), values.row(row).transpose());
    point.pressure = contact_values(row, 0);
    point.lambda = lambda_values[row];
    point.touching = contact_values(row, 1);
    point.face_pressure = contact_values.row(row).segment<2>(2);
    point.face_touching = contact_values.row(row).segment<2>(4);
  }
}

void Recovery::add_resultants(std::size_t cell, const element::CellField& field,
                              std::vector<PointValues>& points) const {
  std::optional<ContinuedResultants> of_cell;
  for (std::size_t p = 0; p < points.size(); ++p) {
    PointValues& point = points[p];
    const SurfaceAxes axes{.t1 = point.t1, .t2 = point.t2, .a3 = point.t1.cross(point.t2)};
    std::optional<Resultants> values;
    if (choice_.patches) values = choice_.patches->at(cell, at_points_.xi[p], point.phi, axes);
    if (!values) {
      if (!of_cell) of_cell.emplace(resultant_points_(cell, field), continuation_);
      values = of_cell->at(p, axes);
    }
    if (point.laminate || point.initial.is_heated())
      *values -= shell::section_at(point.material, shell::orthonormal_frame(point.t1, point.t2), point.thickness,
                                   point.initial)
                     .initial_resultants()
                     .transpose();
    point.N = values->segment<3>(0);
    point.M = values->segment<3>(3);
    point.Q = values->segment<2>(6);
  }
}

std::vector<PointValues> Recovery::operator()(std::size_t cell) const {
  const element::CellField field = discrete_.shell.gather(cell, solution_.y);
  std::vector<PointValues> points = geometry_at_points(cell);
  add_nodal_values(cell, field, points);
  add_resultants(cell, field, points);
  return points;
}

}  // namespace plastron::recovery
