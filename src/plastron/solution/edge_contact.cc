#include <plastron/solution/edge_contact.hpp>

#include <plastron/fem/basis.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <algorithm>

namespace plastron::solution {

namespace {

/// Quadrature on a side whose nodes carry the weights: Gauss-Lobatto. On triangles of degree 2 vertices have no
/// bound, and only the middle has weight.
std::vector<double> side_weights(const fem::Space& space) {
  if (space.shape() == fem::Shape::triangle && space.degree == 2) return {0, 1, 0};
  return fem::gauss_lobatto(space.degree + 1).weights;
}

/// Length of the shell's edges represented by each node; 0 inside.
algebra::Vector edge_lengths(const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  const auto weights = side_weights(space);
  const auto line = fem::gauss_lobatto(space.degree + 1).points;
  algebra::Vector lengths(space.layout, 1);
  std::vector<geometry::SurfaceJet> jets(line.size());
  const fem::BoundarySide* last = nullptr;
  for (const fem::BoundarySide& edge : space.sides) {
    // A side with several names occurs several times.
    const bool is_seen = last && last->cell == edge.cell && last->side == edge.side;
    last = &edge;
    if (is_seen || edge.is_inner || edge.cell >= space.owned_cells) continue;
    std::vector<Eigen::Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(fem::side_point(space.shape(), edge.side, t));
    discrete.shell.surface().jets(space.cells[edge.cell], xi, jets, false);
    const Eigen::Vector2d along = fem::side_tangent(space.shape(), edge.side);
    const auto on_side = fem::side_nodes(space.shape(), space.degree, edge.side);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto node = static_cast<std::size_t>(space.nodes(edge.cell)[static_cast<std::size_t>(on_side[i])]);
      lengths.local()[node] += weights[i] * (along[0] * jets[i].d[0] + along[1] * jets[i].d[1]).norm();
    }
  }
  lengths.accumulate_ghosts();
  fem::collect(space, lengths);
  return lengths;
}

}  // namespace

EdgeContact edge_contact(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  EdgeContact edge;
  if (discrete.obstacles.empty()) return edge;
  const MPI_Comm comm = discrete.space().layout->comm;
  const algebra::Vector lengths = edge_lengths(discrete);
  for (std::size_t i = 0; i < lengths.owned().size(); ++i) {
    if (discrete.coordinates.tied[i] || !touches(solution, i)) continue;
    const double pressure = total_pressure(solution, i), weight = discrete.points[i].weight,
                 length = lengths.owned()[i];
    if (length > 0) {
      edge.nodes += 1;
      edge.force += pressure * weight;
      edge.area += weight;
      edge.max_per_length = std::max(edge.max_per_length, pressure * weight / length);
    } else {
      edge.pressure_inside = std::max(edge.pressure_inside, pressure);
    }
  }
  edge.nodes = algebra::sum_over_ranks(edge.nodes, comm);
  edge.force = algebra::sum_over_ranks(edge.force, comm);
  edge.area = algebra::sum_over_ranks(edge.area, comm);
  edge.max_per_length = algebra::max_over_ranks(edge.max_per_length, comm);
  edge.pressure_inside = algebra::max_over_ranks(edge.pressure_inside, comm);
  return edge;
}

}  // namespace plastron::solution
