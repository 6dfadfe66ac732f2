#include <plastron/assembly/load_vector.hpp>

#include <plastron/fem/basis.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace plastron::assembly {

namespace {

using geometry::Vector3d;

/// Values of a load (force, couple) at points, a row per point.
void add_expression(const VectorExpression& f, std::span<const double> x, std::span<const double> y, int column,
                    CellField& values) {
  std::vector<double> component(x.size());
  for (int k = 0; k < 3; ++k) {
    f[static_cast<std::size_t>(k)].evaluate(x, y, component);
    values.col(column + k) +=
        Eigen::Map<const Eigen::VectorXd>(component.data(), static_cast<Eigen::Index>(component.size()));
  }
}

void add_function(const VectorFunction& f, std::span<const double> x, std::span<const double> y, int column,
                  CellField& values) {
  if (!f) return;
  for (std::size_t p = 0; p < x.size(); ++p)
    values.row(static_cast<Eigen::Index>(p)).segment<3>(column) += f(x[p], y[p]);
}

void add_area_loads(const ShellOperator& shell, const std::vector<AreaLoad>& loads, algebra::Vector& f) {
  const fem::Space& space = shell.space();
  const auto& xi = shell.tables().quadrature.xi;
  std::vector<double> x(xi.size()), y(xi.size()), pressure(xi.size());
  CellField values(static_cast<Eigen::Index>(xi.size()), 6);
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    shell.surface().positions(space.cells[c], xi, x, y);
    values.setZero();
    for (const AreaLoad& load : loads) {
      add_expression(load.force, x, y, 0, values);
      add_expression(load.couple, x, y, 3, values);
      add_function(load.force_function, x, y, 0, values);
      add_function(load.couple_function, x, y, 3, values);
      load.pressure.evaluate(x, y, pressure);
      for (int q = 0; q < values.rows(); ++q)
        values.row(q).head<3>() += pressure[static_cast<std::size_t>(q)] * shell.point(c, q).frame.a3;
    }
    for (int q = 0; q < values.rows(); ++q) values.row(q) *= shell.point(c, q).area;
    shell.scatter(c, shell.interpolation().forces_of(c, shell.tables().quadrature, values), f);
  }
}

void add_edge_load(const ShellOperator& shell, const EdgeLoad& load, algebra::Vector& f) {
  const fem::Space& space = shell.space();
  const auto& names = space.coarse->boundaries;
  const auto found = std::ranges::find(names, load.boundary);
  if (found == names.end())
    throw LoadError(fmt::format("a load names the boundary \"{}\", which the mesh does not have; it has: {}",
                                load.boundary, fmt::join(names, ", ")));
  const auto boundary = static_cast<int>(found - names.begin());
  const fem::Rule rule = fem::gauss(space.degree + 1);
  std::vector<double> x(rule.points.size()), y(rule.points.size());
  std::vector<geometry::SurfaceJet> jets(rule.points.size());
  for (const fem::BoundaryFace& face : space.faces) {
    if (face.boundary != boundary || face.cell >= space.owned_cells) continue;
    std::vector<Eigen::Vector2d> xi;
    for (const double t : rule.points) xi.push_back(fem::side_point(space.shape(), face.side, t));
    shell.surface().positions(space.cells[face.cell], xi, x, y);
    shell.surface().jets(space.cells[face.cell], xi, jets, false);
    CellField values = CellField::Zero(static_cast<Eigen::Index>(xi.size()), 6);
    add_expression(load.force, x, y, 0, values);
    add_expression(load.couple, x, y, 3, values);
    const Eigen::Vector2d along = fem::side_tangent(space.shape(), face.side);
    for (std::size_t q = 0; q < xi.size(); ++q)
      values.row(static_cast<Eigen::Index>(q)) *=
          rule.weights[q] * (along[0] * jets[q].d[0] + along[1] * jets[q].d[1]).norm();
    const BasisAt basis = basis_at(space.shape(), space.degree, xi);
    shell.scatter(face.cell, shell.interpolation().forces_of(face.cell, basis, values), f);
  }
}

}  // namespace

algebra::Vector load_vector(const ShellOperator& shell, const std::vector<AreaLoad>& area_loads,
                            const std::vector<EdgeLoad>& edge_loads) {
  algebra::Vector f(shell.space().layout, 6);
  add_area_loads(shell, area_loads, f);
  for (const EdgeLoad& load : edge_loads) add_edge_load(shell, load, f);
  f.accumulate_ghosts();
  return f;
}

}  // namespace plastron::assembly
