#include <plastron/estimation/point_values.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/recovery/resultants.hpp>

#include <limits>
#include <stdexcept>

namespace plastron::estimation {

namespace {

struct Place {
  std::size_t cell;
  Eigen::Vector2d xi;
};

/// On the lowest rank that has a cell with the point, nothing on the others (collective).
std::optional<Place> place_of(const Eigen::Vector2d& at, const fem::Space& space) {
  const auto location = fem::locate(*space.coarse, at);
  if (!location) throw std::logic_error("a goal lies outside of the domain");  // goals are checked where they are named
  std::optional<Place> place;
  for (std::size_t c = 0; c < space.owned_cells && !place; ++c)
    if (const auto xi = fem::local_coordinates(space.shape(), space.cells[c], *location)) place = Place{c, *xi};
  int rank = 0;
  MPI_Comm_rank(space.layout->comm, &rank);
  const double first = algebra::min_over_ranks(place ? rank : std::numeric_limits<double>::max(), space.layout->comm);
  if (first != rank) place.reset();
  return place;
}

/// J(v) = forces : v on the nodes of the place's cell.
Derivative linear(const std::optional<Place>& place, const element::CellField& forces, const Solved& solved) {
  const assembly::ShellOperator& shell = solved.discrete.shell;
  const algebra::Vector none(solved.box.load.layout(), solved.box.load.block());
  Derivative result{.dual = {.load = none, .held = none}};
  algebra::Vector f(shell.space().layout, 6);
  double value = 0;
  if (place) {
    shell.scatter(place->cell, forces, f);
    value = forces.cwiseProduct(shell.gather(place->cell, solved.nodal.y)).sum();
  }
  f.accumulate_ghosts();
  solved.discrete.coordinates.add_transposed(f, result.dual.load);
  result.value = algebra::sum_over_ranks(value, shell.space().layout->comm);
  return result;
}

/// One resultant of the cell alone, continued to the point; linear in `field`.
class CellResultant {
 public:
  CellResultant(const PointResultant& point, const Place& place, const assembly::DiscreteShell& discrete)
      : point_(point), place_(place), points_(discrete, point.axis) {
    const fem::Space& space = discrete.space();
    continuation_ = element::resultant_continuation(space.shape(), space.degree, {place.xi});
    std::vector<geometry::SurfaceJet> jet(1);
    discrete.shell.surface().parameter_jets(space.cells[place.cell], std::vector{place.xi}, jet);
    axes_ = recovery::surface_axes(jet[0], geometry::unit_normal(jet[0]), point.axis);
  }
  double operator()(const element::CellField& field) const {
    const recovery::CellResultants all = points_(place_.cell, field);
    double sum = 0;
    for (std::size_t p = 0; p < all.axes.size(); ++p) {
      const auto row = static_cast<Eigen::Index>(p);
      const recovery::Resultants own = all.values.row(row);
      sum += continuation_(0, row) *
             recovery::in_other_axes(own, recovery::change_of_axes(all.axes[p], axes_))[point_.component];
    }
    return sum;
  }

 private:
  const PointResultant& point_;
  const Place& place_;
  recovery::ResultantPoints points_;
  Eigen::MatrixXd continuation_;
  recovery::SurfaceAxes axes_{};
};

}  // namespace

Derivative derivative_of(const PointDisplacement& point, const Solved& solved) {
  const assembly::ShellOperator& shell = solved.discrete.shell;
  const fem::Space& space = shell.space();
  const auto place = place_of(point.at, space);
  element::CellField forces;
  if (place) {
    element::CellField unit = element::CellField::Zero(1, 6);
    unit(0, point.component) = 1;
    forces =
        shell.interpolation().forces_of(place->cell, element::basis_at(space.shape(), space.degree, {place->xi}), unit);
  }
  return linear(place, forces, solved);
}

Derivative derivative_of(const PointResultant& point, const Solved& solved) {
  const fem::Space& space = solved.discrete.space();
  const auto place = place_of(point.at, space);
  element::CellField forces = element::CellField::Zero(space.nodes_per_cell(), 6);
  if (place) {
    const CellResultant resultant(point, *place, solved.discrete);
    element::CellField unit = forces;
    for (Eigen::Index i = 0; i < unit.size(); ++i) {
      unit.data()[i] = 1;
      forces.data()[i] = resultant(unit);
      unit.data()[i] = 0;
    }
  }
  return linear(place, forces, solved);
}

}  // namespace plastron::estimation
