#include <plastron/energy/follower_pressure.hpp>

#include <plastron/geometry/frame.hpp>
#include <plastron/geometry/rotation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::energy {

namespace {

/// Adds one load to the values of a cell.
void add_pressure(const ShellOperator& shell, const AreaLoad& load, std::size_t cell, Eigen::VectorXd& values) {
  const element::ElementTables& tables = shell.tables();
  const auto places = shell.surface().places(shell.space().cells[cell], tables.quadrature.xi,
                                             load.pressure.uses_space() || load.where.uses_space());
  std::vector<double> at_points(places.size()), acts(places.size());
  load.pressure.evaluate(places, at_points);
  load.where.evaluate(places, acts);
  for (std::size_t q = 0; q < places.size(); ++q) {
    if (!std::isfinite(at_points[q]))
      throw LoadError(
          fmt::format("a pressure is infinite or not a number near x = {:.6g}, y = {:.6g}; loads must be "
                      "finite in all of the domain",
                      places[q].x, places[q].y));
    const geometry::Frame frame = shell.frame_at(cell, static_cast<int>(q));
    const double side = frame.a_cov[0].cross(frame.a_cov[1]).dot(geometry::surface_normal(frame)) > 0 ? 1 : -1;
    if (acts[q] != 0) values[static_cast<Eigen::Index>(q)] += side * tables.weights[q] * at_points[q];
  }
}

/// Returns the nodal forces of the pressure on a cell.
element::CellField forces_on(const ShellOperator& shell, std::size_t cell, const Eigen::VectorXd& pressure,
                             const CellGeometry& at) {
  element::CellField values = element::CellField::Zero(pressure.size(), 6);
  for (Eigen::Index q = 0; q < pressure.size(); ++q) {
    const geometry::Frame& frame = at.frames[static_cast<std::size_t>(q)];
    values.row(q).head<3>() = pressure[q] * frame.a_cov[0].cross(frame.a_cov[1]);
  }
  return shell.interpolation().forces_of(cell, shell.tables().quadrature, values);
}

}  // namespace

std::vector<Eigen::VectorXd> follower_pressure(const ShellOperator& shell, const Loads& loads) {
  const fem::Space& space = shell.space();
  if (std::ranges::none_of(loads.on_areas, &AreaLoad::follows)) return {};
  std::vector<Eigen::VectorXd> all(space.owned_cells);
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    for (const AreaLoad& load : loads.on_areas) {
      if (!load.follows || !load.acts_in(region_of(*space.coarse, space.cells[c]))) continue;
      if (all[c].size() == 0) all[c] = Eigen::VectorXd::Zero(shell.tables().points_per_cell());
      add_pressure(shell, load, c, all[c]);
    }
  return all;
}

algebra::Vector change_of_follower_forces(const ShellOperator& shell, const std::vector<Eigen::VectorXd>& pressure,
                                          const algebra::Vector& y) {
  algebra::Vector f(shell.space().layout, 6);
  for (std::size_t c = 0; c < pressure.size(); ++c) {
    if (pressure[c].size() == 0) continue;
    shell.scatter(c, forces_on(shell, c, pressure[c], shell.geometry(c, shell.gather(c, y))), f);
    shell.scatter(c, -forces_on(shell, c, pressure[c], shell.geometry(c)), f);
  }
  f.accumulate_ghosts();
  return f;
}

RowMatrix follower_stiffness(const ShellOperator& shell, const Eigen::VectorXd& pressure, const CellGeometry& at) {
  const element::BasisAt& basis = shell.tables().quadrature;
  const int nodes = shell.tables().nodes_per_cell();
  RowMatrix k = RowMatrix::Zero(6 * nodes, 6 * nodes);
  for (Eigen::Index q = 0; q < pressure.size(); ++q) {
    const geometry::Frame& frame = at.frames[static_cast<std::size_t>(q)];
    const Eigen::Matrix3d first = -pressure[q] * geometry::cross_matrix(frame.a_cov[1]),
                          second = pressure[q] * geometry::cross_matrix(frame.a_cov[0]);
    // d(y_1 x y_2) = first d_1 v + second d_2 v
    for (Eigen::Index j = 0; j < nodes; ++j) {
      const Eigen::Matrix3d of_node = basis.d1(q, j) * first + basis.d2(q, j) * second;
      for (Eigen::Index i = 0; i < nodes; ++i) k.block<3, 3>(6 * i, 6 * j) -= basis.value(q, i) * of_node;
    }
  }
  return (k + k.transpose()) / 2;
}

}  // namespace plastron::energy
