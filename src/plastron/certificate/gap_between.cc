#include <plastron/certificate/gap_between.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <limits>

namespace plastron::certificate {

namespace {

/// Between its nodes a polynomial leaves the range of its nodal values by less than the width of that range, and the
/// undeformed surface, which no polynomial bounds, by less than the cell's diameter.
bool is_near_obstacle(const assembly::DiscreteShell& discrete, std::size_t obstacle, const algebra::Vector& y,
                      std::span<const algebra::LocalIndex> nodes) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, radius = 0;
  const Vector3d& first = discrete.points[static_cast<std::size_t>(nodes[0])].phi;
  for (const algebra::LocalIndex index : nodes) {
    const auto node = static_cast<std::size_t>(index);
    const double g = discrete.nodal_gap(obstacle, node, y);
    lowest = std::min(lowest, g);
    highest = std::max(highest, g);
    radius = std::max(radius, (discrete.points[node].phi - first).norm());
  }
  return lowest <= highest - lowest + 2 * radius;
}

/// Twice as fine as the nodes, and in elements of degree 1 four times.
int intervals_of(int degree) { return std::max(4, 2 * degree); }

}  // namespace

void sample_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y, int intervals,
                 const GapVisitor& visit) {
  const fem::Space& space = discrete.space();
  const element::BasisAt basis = element::basis_at(space.shape(), space.degree, fem::lattice(space.shape(), intervals));
  std::vector<double> gaps(basis.xi.size());
  std::vector<geometry::SurfaceJet> jets(basis.xi.size());
  std::vector<double> px(jets.size()), py(jets.size()), e(jets.size());
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const element::CellField field = discrete.shell.gather(c, y);
    std::vector<std::size_t> near;
    for (std::size_t k = 0; k < discrete.coordinates.gaps.size(); ++k)
      if (is_near_obstacle(discrete, k, y, space.nodes(c))) near.push_back(k);
    if (near.empty()) continue;
    discrete.shell.surface().jets(space.cells[c], basis.xi, jets, false);
    discrete.shell.surface().positions(space.cells[c], basis.xi, px, py);
    discrete.shell.section(c).thickness.evaluate(px, py, e);
    const element::CellField values = discrete.shell.interpolation().values(c, basis, field);
    const element::CellField moved = discrete.state_values(c, basis);
    for (const std::size_t k : near) {
      for (std::size_t p = 0; p < jets.size(); ++p) {
        const auto row = values.row(static_cast<Eigen::Index>(p));
        const Vector3d a3 = geometry::unit_normal(jets[p]);
        const obstacle::Gap gap = discrete.gap(
            k, assembly::shell_point(jets[p].value, a3, e[p], moved.row(static_cast<Eigen::Index>(p)).transpose()));
        gaps[p] = gap(row.head<3>(), geometry::tangential(row.tail<3>(), a3));
      }
      visit(c, k, gaps);
    }
  }
}

double min_gap_between_nodes(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                             std::optional<int> intervals) {
  if (discrete.obstacles.empty()) return std::numeric_limits<double>::infinity();
  const MPI_Comm comm = discrete.space().layout->comm;
  double smallest = std::numeric_limits<double>::infinity();
  algebra::in_agreement<obstacle::ObstacleError>(comm, [&] {
    sample_gaps(discrete, y, intervals.value_or(intervals_of(discrete.space().degree)),
                [&](std::size_t, std::size_t, std::span<const double> gaps) {
                  smallest = std::min(smallest, *std::ranges::min_element(gaps));
                });
  });
  return algebra::min_over_ranks(smallest, comm);
}

}  // namespace plastron::certificate
