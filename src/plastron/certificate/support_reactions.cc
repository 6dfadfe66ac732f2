#include <plastron/certificate/support_reactions.hpp>

#include <algorithm>

namespace plastron::certificate {

namespace {

std::vector<std::string> supported_boundaries(const assembly::DiscreteShell& discrete) {
  std::vector<std::string> names;
  for (const assembly::Support& support : discrete.supports)
    if (!support.point && std::ranges::find(names, support.boundary) == names.end()) names.push_back(support.boundary);
  return names;
}

/// At every node, for each name: positive where the node lies on that boundary (collective).
algebra::Vector marks_of(const fem::Space& space, const std::vector<std::string>& names) {
  algebra::Vector marks(space.layout, static_cast<int>(names.size()));
  const auto mark = [&](const fem::BoundarySide& side) {
    if (side.cell >= space.owned_cells || side.boundary < 0) return;
    const auto found = std::ranges::find(names, space.coarse->boundaries[static_cast<std::size_t>(side.boundary)]);
    if (found == names.end()) return;
    const auto name = static_cast<std::size_t>(found - names.begin());
    for (const int node : fem::side_nodes(space.shape(), space.degree, side.side))
      marks.local()[static_cast<std::size_t>(space.nodes(side.cell)[static_cast<std::size_t>(node)]) * names.size() +
                    name] = 1;
  };
  std::ranges::for_each(space.sides, mark);
  std::ranges::for_each(space.twin_sides, mark);
  marks.accumulate_ghosts();
  return marks;
}

}  // namespace

std::vector<SupportReaction> support_reactions(const assembly::DiscreteShell& discrete,
                                               const std::vector<NodalSupportForce>& forces) {
  const std::vector<std::string> names = supported_boundaries(discrete);
  if (names.empty()) return {};
  const algebra::Vector marks = marks_of(discrete.space(), names);
  const auto name_of = [&](std::size_t node) {
    const auto own = marks.local().subspan(node * names.size(), names.size());
    return static_cast<std::size_t>(std::ranges::find_if(own, [](double mark) { return mark > 0; }) - own.begin());
  };
  std::vector<SupportReaction> reactions(names.size());
  for (std::size_t k = 0; k < names.size(); ++k) reactions[k].boundary = names[k];
  for (const NodalSupportForce& at : forces) {
    const std::size_t name = name_of(at.node);
    if (name == names.size()) continue;  // held as a point
    const assembly::NodalPoint& point = discrete.points[at.node];
    reactions[name].nodes += 1;
    reactions[name].reaction += nodal_wrench(point.phi, point.a3, at.force);
  }
  const MPI_Comm comm = discrete.space().layout->comm;
  for (SupportReaction& reaction : reactions) {
    reaction.nodes = algebra::sum_over_ranks(reaction.nodes, comm);
    reaction.reaction = over_ranks(reaction.reaction, comm);
  }
  return reactions;
}

}  // namespace plastron::certificate
