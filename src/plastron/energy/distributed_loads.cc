#include <plastron/energy/distributed_loads.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/element/piece_rules.hpp>
#include <plastron/element/subdivision.hpp>
#include <plastron/geometry/pieces.hpp>
#include <plastron/mesh/basis.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

namespace plastron::energy {

using geometry::Vector3d;

namespace {

/// Adds values of a load (force, couple) at points, one row for each point.
void add_expression(const VectorExpression& f, std::span<const geometry::Place> places, int column,
                    element::CellField& values) {
  std::vector<double> component(places.size());
  for (int k = 0; k < 3; ++k) {
    f[static_cast<std::size_t>(k)].evaluate(places, component);
    values.col(column + k) +=
        Eigen::Map<const Eigen::VectorXd>(component.data(), static_cast<Eigen::Index>(component.size()));
  }
}

template <class Load>
bool uses_space(const Load& load) {
  const auto any = [](const VectorExpression& f) { return std::ranges::any_of(f, &geometry::Expression::uses_space); };
  if constexpr (requires { load.pressure; })
    if (load.pressure.uses_space()) return true;
  return load.where.uses_space() || any(load.force) || any(load.couple);
}

void add_function(const VectorFunction& f, std::span<const geometry::Place> places, int column,
                  element::CellField& values) {
  if (!f) return;
  for (std::size_t p = 0; p < places.size(); ++p)
    values.row(static_cast<Eigen::Index>(p)).segment<3>(column) += f(places[p].x, places[p].y);
}

/// Sets values to 0 at places where a load does not act. Returns whether it acts at some place.
bool keep_where(const geometry::Expression& where, std::span<const geometry::Place> places,
                element::CellField& values) {
  if (where.is_constant() && where(0, 0) != 0) return true;
  std::vector<double> holds(places.size());
  where.evaluate(places, holds);
  for (std::size_t p = 0; p < places.size(); ++p)
    if (holds[p] == 0) values.row(static_cast<Eigen::Index>(p)).setZero();
  return std::ranges::any_of(holds, [](double value) { return value != 0; });
}

std::string acts_nowhere(const geometry::Expression& where) {
  return fmt::format("a load acts nowhere: where = \"{}\" holds at no place of it", where.text());
}

/// Pieces of expressions that have several pieces.
class LoadPieces {
 public:
  void add(const geometry::Expression& f) {
    if (geometry::is_piecewise(f)) all_.emplace_back(f);
  }
  void add(const VectorExpression& f) {
    for (const geometry::Expression& component : f) add(component);
  }
  void append_to(element::PiecesOfAll& functions) const {
    for (const geometry::Pieces& f : all_) functions.push_back(&f);
  }

 private:
  std::vector<geometry::Pieces> all_{};
};

/// Loads that act on the area of one region.
struct RegionLoads {
  std::vector<const AreaLoad*> loads{};
  const geometry::Expression* thickness = nullptr;
  Vector3d weight = Vector3d::Zero();  ///< rho g [N/m^3], to be multiplied by e
  element::PiecesOfAll functions{};    ///< load functions that have several pieces
  bool use_space = false;              ///< whether a function uses X, Y or Z

  bool is_empty() const { return loads.empty() && weight.isZero(0); }
};

/// Sums loads, and remembers the first place where a load is not finite.
class LoadSum {
 public:
  /// `is_spot`: the loads act in one spot, and their sums are put right afterwards, so a coarse rule is enough.
  LoadSum(const ShellOperator& shell, algebra::Vector& f, bool is_spot)
      : shell_(shell), space_(shell.space()), line_(mesh::gauss(space_.degree + 1)), f_(f), is_spot_(is_spot) {}

  void add_area_loads(const std::vector<AreaLoad>& all, const Vector3d& gravity) {
    std::vector<LoadPieces> pieces(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      check_regions(all[k]);
      pieces[k].add(all[k].force);
      pieces[k].add(all[k].couple);
      pieces[k].add(all[k].pressure);
      pieces[k].add(all[k].where);
    }
    for (std::size_t c = 0; c < space_.owned_cells; ++c) {
      const RegionLoads loads = loads_on(c, all, pieces, gravity);
      if (!loads.is_empty()) shell_.scatter(c, on_cell(loads, c), f_);
    }
  }

  void add_edge_load(const EdgeLoad& load) {
    const auto& names = space_.coarse->boundaries;
    const auto found = std::ranges::find(names, load.boundary);
    if (found == names.end())
      throw LoadError(fmt::format("a load names the boundary \"{}\", which the mesh does not have; it has: {}",
                                  load.boundary, fmt::join(names, ", ")));
    const auto boundary = static_cast<int>(found - names.begin());
    LoadPieces pieces;
    pieces.add(load.force);
    pieces.add(load.couple);
    pieces.add(load.where);
    element::PiecesOfAll functions;
    pieces.append_to(functions);
    for (const fem::BoundarySide& edge : space_.sides)
      if (edge.boundary == boundary && edge.cell < space_.owned_cells)
        shell_.scatter(edge.cell, on_side(load, edge, functions), f_);
  }

  /// Whether a load acts at some place of the cells of this rank.
  bool acts(const void* load) const { return acting_.contains(load); }

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

  RegionLoads loads_on(std::size_t c, const std::vector<AreaLoad>& all, const std::vector<LoadPieces>& pieces,
                       const Vector3d& gravity) const {
    const CrossSection& section = shell_.section(c);
    const std::string& region = region_of(*space_.coarse, space_.cells[c]);
    RegionLoads loads{.thickness = &section.thickness,
                      .weight = section.density * gravity,
                      .use_space = section.thickness.uses_space()};
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!all[k].acts_in(region)) continue;
      loads.loads.push_back(&all[k]);
      pieces[k].append_to(loads.functions);
      loads.use_space = loads.use_space || uses_space(all[k]);
    }
    return loads;
  }

  /// Returns loads at points of a cell with unit normals of the surface.
  template <class NormalAt>
  element::CellField values(const RegionLoads& loads, std::size_t c, const std::vector<Vector2d>& xi,
                            const NormalAt& normal) {
    std::vector<double> pressure(xi.size());
    const std::vector<geometry::Place> places = shell_.surface().places(space_.cells[c], xi, loads.use_space);
    element::CellField values = element::CellField::Zero(static_cast<Eigen::Index>(xi.size()), 6);
    for (const AreaLoad* load : loads.loads) {
      element::CellField own = element::CellField::Zero(values.rows(), 6);
      add_expression(load->force, places, 0, own);
      add_expression(load->couple, places, 3, own);
      add_function(load->force_function, places, 0, own);
      add_function(load->couple_function, places, 3, own);
      load->pressure.evaluate(places, pressure);
      for (int q = 0; q < own.rows(); ++q) own.row(q).head<3>() += pressure[static_cast<std::size_t>(q)] * normal(q);
      if (keep_where(load->where, places, own)) acting_.insert(load);
      values += own;
    }
    if (!loads.weight.isZero(0)) add_weight(loads, places, values);
    note(values, places);
    return values;
  }

  /// Adds the weight rho e g.
  static void add_weight(const RegionLoads& loads, std::span<const geometry::Place> places,
                         element::CellField& values) {
    std::vector<double> e(places.size());
    loads.thickness->evaluate(places, e);
    for (int q = 0; q < values.rows(); ++q) values.row(q).head<3>() += e[static_cast<std::size_t>(q)] * loads.weight;
  }

  element::Places places_in(std::size_t c, bool in_space) const {
    return [this, c, in_space](std::span<const Vector2d> xi) {
      return shell_.surface().places(space_.cells[c], xi, in_space);
    };
  }

  element::CellField on_cell(const RegionLoads& loads, std::size_t c) {
    const element::Places places = places_in(c, loads.use_space);
    if (element::are_one_piece(loads.functions, space_.shape(), places)) return on_smooth_cell(loads, c);
    const element::ElementTables& tables = shell_.tables();
    std::optional<element::PieceRule> rule;
    if (!is_spot_) rule = element::rule_between_borders(loads.functions, space_.shape(), space_.degree, places);
    constexpr std::size_t many = 30'000, few = 500;
    if (!rule)
      rule = element::rule_of_parts(loads.functions, space_.shape(), {tables.quadrature.xi, tables.weights}, places,
                                    is_spot_ ? few : many);
    return on_points(loads, c, rule->xi, rule->weights);
  }

  element::CellField on_smooth_cell(const RegionLoads& loads, std::size_t c) {
    const element::BasisAt& at = shell_.tables().quadrature;
    element::CellField v =
        values(loads, c, at.xi, [&](int q) { return geometry::surface_normal(shell_.point(c, q).frame); });
    for (int q = 0; q < v.rows(); ++q) v.row(q) *= shell_.point(c, q).area;
    return shell_.interpolation().forces_of(c, at, v);
  }

  element::CellField on_points(const RegionLoads& loads, std::size_t c, const std::vector<Vector2d>& xi,
                               std::span<const double> weights) {
    std::vector<geometry::Frame> frames(xi.size());
    shell_.surface().frames(space_.cells[c], xi, frames, false);
    element::CellField v =
        values(loads, c, xi, [&](int q) { return geometry::surface_normal(frames[static_cast<std::size_t>(q)]); });
    for (int q = 0; q < v.rows(); ++q)
      v.row(q) *= weights[static_cast<std::size_t>(q)] * frames[static_cast<std::size_t>(q)].sqrt_a;
    return shell_.interpolation().forces_of(c, element::basis_at(space_.shape(), space_.degree, xi), v);
  }

  element::CellField on_side(const EdgeLoad& load, const fem::BoundarySide& edge,
                             const element::PiecesOfAll& functions) {
    if (!functions.empty())
      if (const auto rule = element::rule_between_borders(functions, space_.shape(), edge.side, space_.degree,
                                                          places_in(edge.cell, uses_space(load))))
        return on_side_points(load, edge, rule->xi, rule->weights);
    const auto integral = [&](const element::SidePart& part) { return on_side_part(load, edge, part); };
    constexpr int levels = 20;  // halving a side costs little
    return functions.empty()
               ? integral(element::SidePart{})
               : element::Subdivision<element::SidePart, decltype(integral)>(space_.shape(), integral)(levels);
  }

  element::CellField on_side_part(const EdgeLoad& load, const fem::BoundarySide& edge, const element::SidePart& part) {
    std::vector<Vector2d> xi;
    std::vector<double> weights = line_.weights;
    for (const double t : line_.points)
      xi.push_back(mesh::side_point(space_.shape(), edge.side, part.start + part.length * t));
    for (double& weight : weights) weight *= part.length;
    return on_side_points(load, edge, xi, weights);
  }

  element::CellField on_side_points(const EdgeLoad& load, const fem::BoundarySide& edge,
                                    const std::vector<Vector2d>& xi, std::span<const double> weights) {
    const std::vector<geometry::Place> places = shell_.surface().places(space_.cells[edge.cell], xi, uses_space(load));
    std::vector<geometry::Frame> frames(xi.size());
    shell_.surface().frames(space_.cells[edge.cell], xi, frames, false);
    element::CellField values = element::CellField::Zero(static_cast<Eigen::Index>(xi.size()), 6);
    add_expression(load.force, places, 0, values);
    add_expression(load.couple, places, 3, values);
    if (keep_where(load.where, places, values)) acting_.insert(&load);
    note(values, places);
    const Vector2d along = mesh::side_tangent(space_.shape(), edge.side);
    for (std::size_t q = 0; q < xi.size(); ++q)
      values.row(static_cast<Eigen::Index>(q)) *= weights[q] * geometry::along(frames[q], along).norm();
    return shell_.interpolation().forces_of(edge.cell, element::basis_at(space_.shape(), space_.degree, xi), values);
  }

  void note(const element::CellField& values, std::span<const geometry::Place> places) {
    for (std::size_t q = 0; q < places.size() && !not_finite_; ++q)
      if (!values.row(static_cast<Eigen::Index>(q)).allFinite()) not_finite_ = Vector2d(places[q].x, places[q].y);
  }

  const ShellOperator& shell_;
  const fem::Space& space_;
  mesh::Rule line_;
  algebra::Vector& f_;
  bool is_spot_;
  std::optional<Vector2d> not_finite_{};
  std::set<const void*> acting_{};  ///< loads that act at some place
};

}  // namespace

algebra::Vector distributed_forces(const ShellOperator& shell, const Loads& loads, bool is_spot) {
  algebra::Vector f(shell.space().layout, 6);
  MPI_Comm comm = shell.space().layout->comm;
  LoadSum sum(shell, f, is_spot);
  // Loads may be functions of the caller, and only one rank may find a value that is not finite.
  algebra::in_agreement<LoadError>(comm, [&] {
    sum.add_area_loads(loads.on_areas, loads.gravity);
    for (const EdgeLoad& load : loads.on_edges) sum.add_edge_load(load);
    sum.throw_if_not_finite();
  });
  f.accumulate_ghosts();
  const auto check = [&](const auto& all) {
    for (const auto& load : all)
      if (!load.where.is_constant() && algebra::sum_over_ranks(sum.acts(&load) ? 1.0 : 0.0, comm) == 0)
        throw LoadError(acts_nowhere(load.where));
  };
  if (!is_spot) check(loads.on_areas);
  if (!is_spot) check(loads.on_edges);
  return f;
}

}  // namespace plastron::energy
