#include <plastron/solution/pushed_sideways.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/basis.hpp>
#include <plastron/obstacle/error.hpp>

#include <cmath>

namespace plastron::solution {

namespace {

/// Marks the nodes on the boundary of the domain.
std::vector<char> nodes_on_edges(const fem::Space& space) {
  std::vector<char> marks(static_cast<std::size_t>(space.layout->local_size()));
  for (const fem::BoundarySide& side : space.sides)
    if (!side.is_inner)
      for (const int i : fem::side_nodes(space.shape(), space.degree, side.side))
        marks[static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(i)])] = 1;
  return marks;
}

/// Owned nodes pushed by an obstacle along the shell out of a place deep inside it.
struct PushedSideways {
  std::int64_t nodes = 0;
  double force = 0, all_forces = 0;  ///< at touching nodes inside the shell; at all touching nodes [N]
};
PushedSideways pushed_sideways(const assembly::DiscreteShell& discrete, const NodalSolution& solution, std::size_t k,
                               const std::vector<char>& on_edges) {
  constexpr double sideways = 0.5;      // cosine between the obstacle's normal and the shell's: 60 degrees
  constexpr double deep_inside = 0.25;  // part of the thickness
  const obstacle::Obstacle obstacle = discrete.obstacles.now(k);
  PushedSideways pushed;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const std::size_t at = i * discrete.obstacles.all.size() + k;
    if (solution.touching.local()[at] == 0) continue;
    const obstacle::Gap& gap = discrete.coordinates.gaps[k][i];
    const assembly::NodalPoint& point = discrete.points[i];
    const double force = solution.pressure.local()[at] * point.weight;
    pushed.all_forces += force;
    if (!(std::abs(gap.normal.dot(point.a3)) < sideways) ||
        !(obstacle.nearest(gap.contact_point).distance < -deep_inside * point.thickness))
      continue;
    pushed.nodes += 1;
    if (!on_edges[i]) pushed.force += force;
  }
  return pushed;
}

}  // namespace

void add_pushed_sideways(const assembly::DiscreteShell& discrete, const NodalSolution& solution, Summary& summary) {
  const MPI_Comm comm = discrete.space().layout->comm;
  const std::vector<char> on_edges = nodes_on_edges(discrete.space());
  for (std::size_t k = 0; k < summary.obstacles.size(); ++k) {
    const auto pushed = algebra::in_agreement<obstacle::ObstacleError>(
        comm, [&] { return pushed_sideways(discrete, solution, k, on_edges); });
    summary.obstacles[k].sideways_nodes = algebra::sum_over_ranks(pushed.nodes, comm);
    const double all_forces = algebra::sum_over_ranks(pushed.all_forces, comm);
    summary.obstacles[k].sideways_part = all_forces > 0 ? algebra::sum_over_ranks(pushed.force, comm) / all_forces : 0;
  }
}

}  // namespace plastron::solution
