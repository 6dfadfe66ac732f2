#include <plastron/solution/contact_forces.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <set>
#include <tuple>

namespace plastron::solution {

assembly::Vector6 contact_force(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                const assembly::ContactRow& row) {
  const auto k = static_cast<std::size_t>(row.obstacle);
  if (solution.touching.at(row.node)[k] == 0) return assembly::Vector6::Zero();
  const assembly::NodalPoint& point = discrete.place(row.node);
  const obstacle::Gap& gap = discrete.coordinates.gaps[k][row.node];
  assembly::Vector6 gap_row;  // it contains only the tangential part of r (D4)
  gap_row << gap.normal, gap.arm * geometry::tangential(gap.normal, point.a3);
  return solution.pressure.at(row.node)[k] * point.weight * gap_row;
}

std::vector<ContactForce> contact_forces(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  std::vector<ContactForce> mine;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
      if (discrete.space().continuity.constrains(i) || solution.touching.at(i)[k] == 0) continue;
      const assembly::NodalPoint& point = discrete.points[i];
      const obstacle::Gap& gap = discrete.coordinates.gaps[k][i];
      const double pressure = solution.pressure.at(i)[k];
      mine.push_back({.obstacle = k,
                      .x = point.x,
                      .place = discrete.touching_place(k, i),
                      .displacement = assembly::node_values(solution.y, i).head<3>(),
                      .force = pressure * point.weight * gap.normal,
                      .pressure = pressure,
                      .area = point.weight});
    }
  std::vector<ContactForce> forces = algebra::gathered(mine, discrete.space().layout->comm);
  std::ranges::sort(forces, [](const ContactForce& a, const ContactForce& b) {
    return std::tuple(a.obstacle, a.x[0], a.x[1]) < std::tuple(b.obstacle, b.x[0], b.x[1]);
  });
  return forces;
}

namespace {

/// Quadrature on a side whose nodes carry the weights: Gauss-Lobatto. On triangles of degree 2 vertices have no
/// bound, and only the middle has weight.
std::vector<double> side_weights(const fem::Space& space) {
  if (space.shape() == mesh::Shape::triangle && space.degree == 2) return {0, 1, 0};
  return mesh::gauss_lobatto(space.degree + 1).weights;
}

/// Length of the shell's edges represented by each node; 0 inside.
algebra::Vector edge_lengths(const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  const auto weights = side_weights(space);
  const auto line = mesh::gauss_lobatto(space.degree + 1).points;
  algebra::Vector lengths(space.layout, 1);
  std::vector<geometry::Frame> frames(line.size());
  for (const fem::BoundarySide& edge : edge_sides(discrete)) {
    if (edge.cell >= space.owned_cells) continue;
    std::vector<Eigen::Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(mesh::side_point(space.shape(), edge.side, t));
    discrete.shell.surface().frames(space.cells[edge.cell], xi, frames, false);
    const Eigen::Vector2d along = mesh::side_tangent(space.shape(), edge.side);
    const auto on_side = mesh::side_nodes(space.shape(), space.degree, edge.side);
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto node = static_cast<std::size_t>(space.nodes(edge.cell)[static_cast<std::size_t>(on_side[i])]);
      lengths.local()[node] += weights[i] * geometry::along(frames[i], along).norm();
    }
  }
  lengths.accumulate_ghosts();
  space.continuity.apply_transposed(lengths);
  return lengths;
}

}  // namespace

std::vector<fem::BoundarySide> edge_sides(const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  const auto is_mirrored = [&](const fem::BoundarySide& side) {
    return side.boundary >= 0 && std::ranges::any_of(discrete.supports, [&](const assembly::Support& support) {
             return support.symmetry &&
                    support.boundary == space.coarse->boundaries[static_cast<std::size_t>(side.boundary)];
           });
  };
  std::set<std::pair<std::size_t, int>> left_out;  // or taken already: a side with several names occurs several times
  for (const fem::BoundarySide& side : space.sides)
    if (side.is_inner || is_mirrored(side)) left_out.emplace(side.cell, side.side);
  std::vector<fem::BoundarySide> sides;
  for (const fem::BoundarySide& side : space.sides)
    if (left_out.emplace(side.cell, side.side).second) sides.push_back(side);
  return sides;
}

std::vector<char> nodes_on_edges(const assembly::DiscreteShell& discrete) {
  const fem::Space& space = discrete.space();
  std::vector<char> marks(static_cast<std::size_t>(space.layout->local_size()));
  for (const fem::BoundarySide& side : edge_sides(discrete))
    for (const int i : mesh::side_nodes(space.shape(), space.degree, side.side))
      marks[static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(i)])] = 1;
  return marks;
}

EdgeContact edge_contact(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  EdgeContact edge;
  if (discrete.obstacles.empty()) return edge;
  const MPI_Comm comm = discrete.space().layout->comm;
  const algebra::Vector lengths = edge_lengths(discrete);
  for (std::size_t i = 0; i < lengths.owned().size(); ++i) {
    if (discrete.space().continuity.constrains(i) || !touches(solution, i)) continue;
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
