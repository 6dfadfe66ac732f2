#include <plastron/recovery/vertices.hpp>

namespace plastron::recovery {

namespace {

/// 1 at the nodes that are a corner of some cell, on every rank that has them (collective).
algebra::Vector corner_marks(const fem::Space& space, const std::array<std::size_t, 4>& corner_nodes) {
  algebra::Vector marks(space.layout, 1);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (int k = 0; k < fem::corner_count(space.shape()); ++k)
      marks.local()[static_cast<std::size_t>(space.nodes(cell)[corner_nodes[static_cast<std::size_t>(k)]])] = 1;
  marks.accumulate_ghosts();
  marks.update_ghosts();
  return marks;
}

}  // namespace

Vertices::Vertices(const fem::Space& space) {
  const auto k = static_cast<std::size_t>(space.degree);
  if (space.shape() == fem::Shape::quadrilateral)
    corner_nodes_ = {0, k, k * (k + 1), (k + 1) * (k + 1) - 1};
  else
    corner_nodes_ = {0, k, (k + 1) * (k + 2) / 2 - 1, 0};
  algebra::Vector number = corner_marks(space, corner_nodes_);
  const auto owned_nodes = static_cast<std::size_t>(space.layout->owned);
  algebra::Distribution nodes{.comm = space.layout->comm};
  vertex_of_node_.assign(number.local().size(), -1);
  for (std::size_t node = 0; node < owned_nodes; ++node)
    if (number.local()[node] > 0) vertex_of_node_[node] = nodes.owned++;
  const auto count = static_cast<std::int64_t>(nodes.owned);
  MPI_Exscan(&count, &nodes.first, 1, MPI_INT64_T, MPI_SUM, nodes.comm);
  nodes.global_size = algebra::sum_over_ranks(count, nodes.comm);
  // Exchanges global numbers of the vertices for ghosts. They are increased by one, so that 0 means none.
  for (std::size_t node = 0; node < owned_nodes; ++node)
    number.local()[node] = vertex_of_node_[node] < 0 ? 0 : static_cast<double>(nodes.first + vertex_of_node_[node] + 1);
  number.update_ghosts();
  for (std::size_t node = owned_nodes; node < vertex_of_node_.size(); ++node)
    if (number.local()[node] > 0) {
      vertex_of_node_[node] = nodes.local_size();
      nodes.ghosts.push_back(static_cast<algebra::GlobalIndex>(number.local()[node]) - 1);
    }
  layout_ = std::make_shared<const algebra::Layout>(std::move(nodes));
}

}  // namespace plastron::recovery
