#include <plastron/certificate/inside_obstacles.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace plastron::certificate {

namespace {

/// Owned nodes pushed by an obstacle along the shell out of a place deep inside it.
struct PushedSideways {
  std::int64_t nodes = 0;
  double force = 0, all_forces = 0;  ///< at touching nodes inside the shell; at all touching nodes [N]
};
PushedSideways pushed_sideways(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                               std::size_t k, const std::vector<char>& on_edges) {
  constexpr double sideways = 0.5;      // cosine between the obstacle's normal and the shell's: 60 degrees
  constexpr double deep_inside = 0.25;  // part of the thickness
  const obstacle::Obstacle obstacle = discrete.obstacles.now(k);
  PushedSideways pushed;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    if (solution.touching.at(i)[k] == 0) continue;
    const obstacle::Gap& gap = discrete.coordinates.gaps[k][i];
    const assembly::NodalPoint& point = discrete.place(i);
    const double force = solution.pressure.at(i)[k] * point.weight;
    pushed.all_forces += force;
    if (!(std::abs(gap.normal.dot(point.a3)) < sideways) ||
        !(obstacle.nearest(discrete.touching_place(k, i)).distance < -deep_inside * point.thickness))
      continue;
    pushed.nodes += 1;
    if (!on_edges[i]) pushed.force += force;
  }
  return pushed;
}

}  // namespace

std::vector<char> cells_of_bodies(const fem::Space& space) {
  std::vector<char> marks(space.owned_cells), is_of_body(static_cast<std::size_t>(space.layout->local_size()));
  for (const fem::PlacedBody& body : space.bodies)
    for (const fem::BodyNode& member : body.members) is_of_body[static_cast<std::size_t>(member.node)] = 1;
  for (std::size_t cell = 0; cell < marks.size() && !space.bodies.empty(); ++cell)
    marks[cell] = std::ranges::any_of(
        space.nodes(cell), [&](algebra::LocalIndex node) { return is_of_body[static_cast<std::size_t>(node)] != 0; });
  return marks;
}

std::vector<CellGap> add_least_gaps(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                                    solution::Summary& summary) {
  std::vector<CellGap> entered;
  if (discrete.obstacles.empty()) return entered;
  const MPI_Comm comm = discrete.space().layout->comm;
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  auto cells =
      algebra::in_agreement<obstacle::ObstacleError>(comm, [&] { return searched_gaps(discrete, solution.y); });
  const std::vector<char> of_bodies = cells_of_bodies(discrete.space());  // BodyReaction contains their depth
  std::erase_if(cells, [&](const CellGap& cell) { return of_bodies[cell.cell] != 0; });
  for (std::size_t k = 0; k < summary.obstacles.size(); ++k) {
    solution::ObstacleContact& contact = summary.obstacles[k];
    Eigen::Vector2d at(nowhere, nowhere);
    double least = nowhere;
    for (const CellGap& cell : cells)
      if (cell.obstacle == k && cell.gap < least) {
        least = cell.gap;
        at = cell.x;
      }
    contact.least_gap = algebra::min_over_ranks(least, comm);
    if (!std::isfinite(contact.least_gap)) continue;
    if (least > contact.least_gap) at.setConstant(nowhere);
    Eigen::Vector2d place(algebra::min_over_ranks(at[0], comm), 0);
    place[1] = algebra::min_over_ranks(at[0] > place[0] ? nowhere : at[1], comm);
    contact.least_gap_place = fem::place_text(discrete.shell.surface(), place);
  }
  std::ranges::copy_if(cells, std::back_inserter(entered), [](const CellGap& cell) { return cell.gap < 0; });
  return entered;
}

void add_pushed_nodes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                      solution::Summary& summary) {
  const MPI_Comm comm = discrete.space().layout->comm;
  const std::vector<char> on_edges = solution::nodes_on_edges(discrete);
  for (std::size_t k = 0; k < summary.obstacles.size(); ++k) {
    const auto pushed = algebra::in_agreement<obstacle::ObstacleError>(
        comm, [&] { return pushed_sideways(discrete, solution, k, on_edges); });
    summary.obstacles[k].sideways_nodes = algebra::sum_over_ranks(pushed.nodes, comm);
    const double all_forces = algebra::sum_over_ranks(pushed.all_forces, comm);
    summary.obstacles[k].sideways_part = all_forces > 0 ? algebra::sum_over_ranks(pushed.force, comm) / all_forces : 0;
  }
}

}  // namespace plastron::certificate
