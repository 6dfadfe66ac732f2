#include <plastron/solution/support_reactions.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/solution/support_shares.hpp>

namespace plastron::solution {

namespace {

Vector3d place_of(const Eigen::Vector2d& point, const assembly::DiscreteShell& discrete) {
  const auto location = fem::locate(*discrete.space().coarse, point);
  PLASTRON_ASSERT(location, point[0], point[1]);
  return discrete.shell.surface().frame({.coarse = location->coarse}, location->xi, false).phi;
}

}  // namespace

SupportReactions support_reactions(const assembly::DiscreteShell& discrete,
                                   const std::vector<NodalSupportForce>& forces) {
  if (discrete.supports.empty()) return {};
  const SupportShares shares(discrete);
  std::vector<Wrench> wrenches(shares.carriers());
  std::vector<std::int64_t> nodes(shares.boundaries().size(), 0);
  for (const NodalSupportForce& at : forces) {
    const assembly::NodalPoint& point = discrete.place(at.node);
    for (const SupportShares::Share& share : shares.at(at.node)) {
      wrenches[share.carrier] += nodal_wrench(point.phi, point.a3, share.part * at.force);
      if (share.carrier < nodes.size()) nodes[share.carrier] += 1;
    }
  }
  const MPI_Comm comm = discrete.space().layout->comm;
  for (Wrench& wrench : wrenches) wrench = over_ranks(wrench, comm);
  SupportReactions result;
  auto next = wrenches.begin();
  for (std::size_t b = 0; b < nodes.size(); ++b)
    result.boundaries.push_back(
        {.boundary = shares.boundaries()[b], .reaction = *next++, .nodes = algebra::sum_over_ranks(nodes[b], comm)});
  for (const SupportCorner& corner : shares.corners()) {
    result.corners.push_back({.at = corner.at, .position = corner.place, .reaction = *next++});
    for (const std::size_t b : corner.boundaries) result.corners.back().boundaries.push_back(shares.boundaries()[b]);
  }
  for (const Eigen::Vector2d& at : discrete.support_points())
    result.points.push_back({.at = at, .position = place_of(at, discrete), .force = next++->force});
  return result;
}

}  // namespace plastron::solution
