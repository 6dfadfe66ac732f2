#include <plastron/assembly/load_vector.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/element/subdivision.hpp>
#include <plastron/fem/basis.hpp>
#include <plastron/fem/carried_nodes.hpp>
#include <plastron/geometry/piecewise.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

namespace plastron::assembly {

namespace {

/// Values of a load (force, couple) at points, a row per point.
void add_expression(const VectorExpression& f, std::span<const double> x, std::span<const double> y, int column,
                    element::CellField& values) {
  std::vector<double> component(x.size());
  for (int k = 0; k < 3; ++k) {
    f[static_cast<std::size_t>(k)].evaluate(x, y, component);
    values.col(column + k) +=
        Eigen::Map<const Eigen::VectorXd>(component.data(), static_cast<Eigen::Index>(component.size()));
  }
}

void add_function(const VectorFunction& f, std::span<const double> x, std::span<const double> y, int column,
                  element::CellField& values) {
  if (!f) return;
  for (std::size_t p = 0; p < x.size(); ++p)
    values.row(static_cast<Eigen::Index>(p)).segment<3>(column) += f(x[p], y[p]);
}

bool is_piecewise(const VectorExpression& f) {
  return std::ranges::any_of(f, [](const geometry::Expression& c) { return geometry::is_piecewise(c); });
}
bool is_piecewise(const AreaLoad& load) {
  return is_piecewise(load.force) || is_piecewise(load.couple) || geometry::is_piecewise(load.pressure);
}

/// What acts on the area of one region.
struct RegionLoads {
  std::vector<const AreaLoad*> loads{};
  const geometry::Expression* thickness = nullptr;
  Vector3d weight = Vector3d::Zero();  ///< rho g [N/m^3], to be multiplied by e

  bool is_empty() const { return loads.empty() && weight.isZero(0); }
  bool is_piecewise() const {
    return std::ranges::any_of(loads, [](const AreaLoad* load) { return assembly::is_piecewise(*load); });
  }
};

/// Adds loads up, and remembers the first place where one is not finite.
class LoadSum {
 public:
  LoadSum(const ShellOperator& shell, algebra::Vector& f)
      : shell_(shell), space_(shell.space()), line_(fem::gauss(space_.degree + 1)), f_(f) {}

  void add_area_loads(const std::vector<AreaLoad>& all, const Vector3d& gravity) {
    constexpr int levels = 6;
    for (const AreaLoad& load : all) check_regions(load);
    for (std::size_t c = 0; c < space_.owned_cells; ++c) {
      const RegionLoads loads = loads_on(c, all, gravity);
      if (loads.is_empty()) continue;
      const auto integral = [&](const element::CellPart& part) { return on_part(loads, c, part); };
      shell_.scatter(c,
                     loads.is_piecewise()
                         ? element::Subdivision<element::CellPart, decltype(integral)>(space_.shape(), integral)(levels)
                         : on_cell(loads, c),
                     f_);
    }
  }

  void add_edge_load(const EdgeLoad& load) {
    constexpr int levels = 20;  // halving a side costs little
    const auto& names = space_.coarse->boundaries;
    const auto found = std::ranges::find(names, load.boundary);
    if (found == names.end())
      throw LoadError(fmt::format("a load names the boundary \"{}\", which the mesh does not have; it has: {}",
                                  load.boundary, fmt::join(names, ", ")));
    const auto boundary = static_cast<int>(found - names.begin());
    const bool divide = is_piecewise(load.force) || is_piecewise(load.couple);
    for (const fem::BoundarySide& edge : space_.sides) {
      if (edge.boundary != boundary || edge.cell >= space_.owned_cells) continue;
      const auto integral = [&](const element::SidePart& part) { return on_side(load, edge, part); };
      shell_.scatter(edge.cell,
                     divide
                         ? element::Subdivision<element::SidePart, decltype(integral)>(space_.shape(), integral)(levels)
                         : integral(element::SidePart{}),
                     f_);
    }
  }

  void throw_if_not_finite() const {
    if (not_finite_)
      throw LoadError(fmt::format(
          "a load is infinite or not a number near x = {:.6g}, y = {:.6g}; loads must be finite in all of the domain",
          (*not_finite_)[0], (*not_finite_)[1]));
  }

 private:
  void check_regions(const AreaLoad& load) const {
    const auto& known = space_.coarse->regions;
    for (const std::string& region : load.regions)
      if (std::ranges::find(known, region) == known.end())
        throw LoadError(fmt::format("a load names the region \"{}\", which the mesh does not have; it has: {}", region,
                                    fmt::join(known, ", ")));
  }

  RegionLoads loads_on(std::size_t c, const std::vector<AreaLoad>& all, const Vector3d& gravity) const {
    const CrossSection& section = shell_.section(c);
    const std::string& region = region_of(*space_.coarse, space_.cells[c]);
    RegionLoads loads{.thickness = &section.thickness, .weight = section.density * gravity};
    for (const AreaLoad& load : all)
      if (load.acts_in(region)) loads.loads.push_back(&load);
    return loads;
  }

  /// Loads at points of a cell with normals a_3.
  template <class NormalAt>
  element::CellField values(const RegionLoads& loads, std::size_t c, const std::vector<Vector2d>& xi,
                            const NormalAt& a3) {
    std::vector<double> x(xi.size()), y(xi.size()), pressure(xi.size());
    shell_.surface().positions(space_.cells[c], xi, x, y);
    element::CellField values = element::CellField::Zero(static_cast<Eigen::Index>(xi.size()), 6);
    for (const AreaLoad* load : loads.loads) {
      add_expression(load->force, x, y, 0, values);
      add_expression(load->couple, x, y, 3, values);
      add_function(load->force_function, x, y, 0, values);
      add_function(load->couple_function, x, y, 3, values);
      load->pressure.evaluate(x, y, pressure);
      for (int q = 0; q < values.rows(); ++q) values.row(q).head<3>() += pressure[static_cast<std::size_t>(q)] * a3(q);
    }
    if (!loads.weight.isZero(0)) add_weight(loads, x, y, values);
    note(values, x, y);
    return values;
  }

  /// rho e g.
  static void add_weight(const RegionLoads& loads, std::span<const double> x, std::span<const double> y,
                         element::CellField& values) {
    std::vector<double> e(x.size());
    loads.thickness->evaluate(x, y, e);
    for (int q = 0; q < values.rows(); ++q) values.row(q).head<3>() += e[static_cast<std::size_t>(q)] * loads.weight;
  }

  element::CellField on_cell(const RegionLoads& loads, std::size_t c) {
    const element::BasisAt& at = shell_.tables().quadrature;
    element::CellField v = values(loads, c, at.xi, [&](int q) { return shell_.point(c, q).frame.a3; });
    for (int q = 0; q < v.rows(); ++q) v.row(q) *= shell_.point(c, q).area;
    return shell_.interpolation().forces_of(c, at, v);
  }

  element::CellField on_part(const RegionLoads& loads, std::size_t c, const element::CellPart& part) {
    std::vector<Vector2d> xi = shell_.tables().quadrature.xi;
    for (Vector2d& point : xi) point = part.corner + part.size * point;
    std::vector<geometry::SurfaceJet> jets(xi.size());
    shell_.surface().jets(space_.cells[c], xi, jets, false);
    std::vector<Vector3d> normals;
    normals.reserve(jets.size());
    for (const auto& jet : jets) normals.push_back(jet.d[0].cross(jet.d[1]));
    const auto normal = [&](int q) { return normals[static_cast<std::size_t>(q)]; };
    element::CellField v = values(loads, c, xi, [&](int q) { return Vector3d(normal(q).normalized()); });
    for (int q = 0; q < v.rows(); ++q)
      v.row(q) *= shell_.tables().weights[static_cast<std::size_t>(q)] * part.size * part.size * normal(q).norm();
    return shell_.interpolation().forces_of(c, element::basis_at(space_.shape(), space_.degree, xi), v);
  }

  element::CellField on_side(const EdgeLoad& load, const fem::BoundarySide& edge, const element::SidePart& part) {
    std::vector<double> x(line_.points.size()), y(line_.points.size());
    std::vector<geometry::SurfaceJet> jets(line_.points.size());
    std::vector<Vector2d> xi;
    for (const double t : line_.points)
      xi.push_back(fem::side_point(space_.shape(), edge.side, part.start + part.length * t));
    shell_.surface().positions(space_.cells[edge.cell], xi, x, y);
    shell_.surface().jets(space_.cells[edge.cell], xi, jets, false);
    element::CellField values = element::CellField::Zero(static_cast<Eigen::Index>(xi.size()), 6);
    add_expression(load.force, x, y, 0, values);
    add_expression(load.couple, x, y, 3, values);
    note(values, x, y);
    const Vector2d along = fem::side_tangent(space_.shape(), edge.side);
    for (std::size_t q = 0; q < xi.size(); ++q)
      values.row(static_cast<Eigen::Index>(q)) *=
          part.length * line_.weights[q] * (along[0] * jets[q].d[0] + along[1] * jets[q].d[1]).norm();
    return shell_.interpolation().forces_of(edge.cell, element::basis_at(space_.shape(), space_.degree, xi), values);
  }

  void note(const element::CellField& values, std::span<const double> x, std::span<const double> y) {
    for (std::size_t q = 0; q < x.size() && !not_finite_; ++q)
      if (!values.row(static_cast<Eigen::Index>(q)).allFinite()) not_finite_ = Vector2d(x[q], y[q]);
  }

  const ShellOperator& shell_;
  const fem::Space& space_;
  fem::Rule line_;
  algebra::Vector& f_;
  std::optional<Vector2d> not_finite_{};
};

}  // namespace

algebra::Vector load_vector(const ShellOperator& shell, const std::vector<AreaLoad>& area_loads,
                            const std::vector<EdgeLoad>& edge_loads, const Vector3d& gravity) {
  algebra::Vector f(shell.space().layout, 6);
  // Loads may be functions of the caller, and a place where one is not finite is seen by one rank alone.
  algebra::in_agreement<LoadError>(shell.space().layout->comm, [&] {
    LoadSum sum(shell, f);
    sum.add_area_loads(area_loads, gravity);
    for (const EdgeLoad& load : edge_loads) sum.add_edge_load(load);
    sum.throw_if_not_finite();
  });
  f.accumulate_ghosts();
  if (shell.space().carried)
    for (const fem::PlacedBody& body : shell.space().carried->bodies) add_body_load(shell.space(), body, f);
  return f;
}

}  // namespace plastron::assembly
