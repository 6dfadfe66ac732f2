#include <plastron/assembly/gap_between.hpp>

#include <plastron/geometry/frame.hpp>

#include <algorithm>
#include <limits>

namespace plastron::assembly {

namespace {

/// Gap and place of the nodes of a cell.
struct NodeGaps {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  Vector3d low = Vector3d::Constant(lowest), high = -low;

  void add(double gap, const Vector3d& place) {
    lowest = std::min(lowest, gap);
    highest = std::max(highest, gap);
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  /// Between its nodes a polynomial leaves the range of its nodal values by less than the width of that range, and a surface
  /// that bulges out of its nodes, by less than their distance.
  bool may_be_closed() const { return lowest <= highest - lowest + (high - low).norm(); }
};

bool may_touch(const DiscreteShell& discrete, const CellField& field, std::span<const algebra::LocalIndex> nodes) {
  NodeGaps gaps;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto row = field.row(static_cast<Eigen::Index>(i));
    const auto node = static_cast<std::size_t>(nodes[i]);
    const NodalPoint& p = discrete.points[node];
    gaps.add(discrete.coordinates.gaps[node](row.head<3>(), geometry::tangential(row.tail<3>(), p.a3)), p.phi);
  }
  return gaps.may_be_closed();
}

}  // namespace

double min_gap_between_nodes(const DiscreteShell& discrete, const algebra::Vector& y) {
  const fem::Space& space = discrete.space();
  double smallest = std::numeric_limits<double>::infinity();
  if (discrete.gap) {
    const BasisAt basis = basis_at(space.shape(), space.degree, fem::lattice(space.shape(), 2 * space.degree));
    std::vector<geometry::SurfaceJet> jets(basis.xi.size());
    std::vector<double> px(jets.size()), py(jets.size()), e(jets.size());
    for (std::size_t c = 0; c < space.owned_cells; ++c) {
      const CellField field = discrete.shell.gather(c, y);
      if (!may_touch(discrete, field, space.nodes(c))) continue;
      discrete.shell.surface().jets(space.cells[c], basis.xi, jets, false);
      discrete.shell.surface().positions(space.cells[c], basis.xi, px, py);
      discrete.thickness.evaluate(px, py, e);
      const CellField values = discrete.shell.interpolation().values(c, basis, field);
      for (std::size_t p = 0; p < jets.size(); ++p) {
        const auto row = values.row(static_cast<Eigen::Index>(p));
        const Vector3d a3 = geometry::unit_normal(jets[p]);
        const obstacle::Gap gap = discrete.gap(jets[p].value, a3, e[p]);
        smallest = std::min(smallest, gap(row.head<3>(), geometry::tangential(row.tail<3>(), a3)));
      }
    }
  }
  return algebra::min_over_ranks(smallest, space.layout->comm);
}

}  // namespace plastron::assembly
