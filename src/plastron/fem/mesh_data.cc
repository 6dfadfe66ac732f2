#include <plastron/fem/mesh_data.hpp>

#include <plastron/fem/domain.hpp>
#include <plastron/fem/element_type.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::fem {

std::string place_of(const MeshElement& element) {
  return element.line > 0 ? fmt::format("element {} (line {})", element.tag, element.line)
                          : fmt::format("element {}", element.tag);
}

void number_nodes(MeshData& data) {
  std::ranges::sort(data.nodes, {}, &MeshNode::tag);
  const auto twice = std::ranges::adjacent_find(data.nodes, {}, &MeshNode::tag);
  if (twice != data.nodes.end())
    throw DomainError(fmt::format("{}: node {} stands twice, once at ({:g}, {:g})", data.source, twice->tag,
                                  twice->position[0], twice->position[1]));
  for (const MeshElement& element : data.elements) {
    const auto count = static_cast<std::size_t>(element_type(element.type)->nodes);
    for (std::size_t i = element.first_node; i < element.first_node + count; ++i) {
      std::int64_t& node = data.element_nodes[i];
      const auto found = std::ranges::lower_bound(data.nodes, node, {}, &MeshNode::tag);
      if (found == data.nodes.end() || found->tag != node)
        throw DomainError(
            fmt::format("{}: {} has the node {}, which does not exist", data.source, place_of(element), node));
      node = found - data.nodes.begin();
    }
  }
}

}  // namespace plastron::fem
