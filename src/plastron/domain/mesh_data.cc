#include <plastron/domain/mesh_data.hpp>
#include <plastron/geometry/text_file.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::domain {

namespace {

struct Numbered {
  int first, last;  ///< numbers of consecutive orders
  ElementFamily family;
  int order;  ///< order of the first
  bool is_complete;
};

using enum ElementFamily;

constexpr Numbered plane_types[] = {{1, 1, line, 1, true},
                                    {8, 8, line, 2, true},
                                    {26, 28, line, 3, true},
                                    {62, 66, line, 6, true},
                                    {2, 2, triangle, 1, true},
                                    {9, 9, triangle, 2, true},
                                    {21, 21, triangle, 3, true},
                                    {23, 23, triangle, 4, true},
                                    {25, 25, triangle, 5, true},
                                    {42, 46, triangle, 6, true},
                                    {20, 20, triangle, 3, false},
                                    {22, 22, triangle, 4, false},
                                    {24, 24, triangle, 5, false},
                                    {52, 56, triangle, 6, false},
                                    {3, 3, quadrilateral, 1, true},
                                    {10, 10, quadrilateral, 2, true},
                                    {36, 38, quadrilateral, 3, true},
                                    {47, 51, quadrilateral, 6, true},
                                    {16, 16, quadrilateral, 2, false},
                                    {39, 41, quadrilateral, 3, false},
                                    {57, 61, quadrilateral, 6, false}};

/// Tetrahedra, hexahedra, prisms and pyramids.
constexpr int volume_types[][2] = {{4, 7}, {11, 14}, {17, 19}, {29, 33}, {71, 75}, {79, 83}, {87, 131}, {137, 137}};

int node_count(ElementFamily family, int order, bool is_complete) {
  if (family == line) return order + 1;
  if (!is_complete) return (family == triangle ? 3 : 4) * order;
  return mesh::nodes_per_cell(family == triangle ? mesh::Shape::triangle : mesh::Shape::quadrilateral, order);
}

/// Points (i, j) of the lattice in Gmsh's order. The nodes inside an element form an element of lower order.
using Place = std::array<int, 2>;

void add_square(int from, int order, std::vector<Place>& places) {
  if (order < 0) return;
  const int to = from + order;
  if (order == 0) return places.push_back({from, from});
  places.insert(places.end(), {{from, from}, {to, from}, {to, to}, {from, to}});
  for (int k = 1; k < order; ++k) places.push_back({from + k, from});
  for (int k = 1; k < order; ++k) places.push_back({to, from + k});
  for (int k = 1; k < order; ++k) places.push_back({to - k, to});
  for (int k = 1; k < order; ++k) places.push_back({from, to - k});
  add_square(from + 1, order - 2, places);
}

void add_triangle(int from, int order, std::vector<Place>& places) {
  if (order < 0) return;
  const int to = from + order;
  if (order == 0) return places.push_back({from, from});
  places.insert(places.end(), {{from, from}, {to, from}, {from, to}});
  for (int k = 1; k < order; ++k) places.push_back({from + k, from});
  for (int k = 1; k < order; ++k) places.push_back({to - k, from + k});
  for (int k = 1; k < order; ++k) places.push_back({from, to - k});
  add_triangle(from + 1, order - 3, places);
}

}  // namespace

bool is_printable(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 || byte == 0x7f || (byte >= 0x80 && byte < 0xc2) || byte > 0xf4) return false;
    const std::size_t length = byte < 0x80 ? 1 : byte < 0xe0 ? 2 : byte < 0xf0 ? 3 : 4;
    if (i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return false;
    const auto second = length > 1 ? static_cast<unsigned char>(text[i + 1]) : 0;
    if ((byte == 0xe0 && second < 0xa0) || (byte == 0xed && second > 0x9f)) return false;  // overlong; surrogates
    if ((byte == 0xf0 && second < 0x90) || (byte == 0xf4 && second > 0x8f)) return false;  // overlong; beyond Unicode
    if (byte == 0xc2 && second < 0xa0) return false;                                       // control characters C1
    i += length;
  }
  return true;
}

std::string ElementType::name() const {
  constexpr const char* names[] = {"Point", "Line", "Triangle", "Quadrilateral", "Volume"};
  return fmt::format("{} {}", names[static_cast<std::size_t>(family)], nodes);
}

std::optional<ElementType> element_type(std::int64_t number) {
  if (number == 15) return ElementType{};
  for (const Numbered& n : plane_types)
    if (number >= n.first && number <= n.last) {
      const int order = n.order + static_cast<int>(number - n.first);
      return ElementType{n.family, order, node_count(n.family, order, n.is_complete), n.is_complete};
    }
  for (const auto& [first, last] : volume_types)
    if (number >= first && number <= last) return ElementType{.family = volume};
  return {};
}

int element_number(ElementFamily family, int order) {
  const auto found = std::ranges::find_if(plane_types, [&](const Numbered& n) {
    return n.family == family && n.is_complete && order >= n.order && order - n.order <= n.last - n.first;
  });
  return found->first + order - found->order;
}

std::vector<std::size_t> lattice_places(mesh::Shape shape, int order) {
  std::vector<Place> places;
  if (shape == mesh::Shape::triangle)
    add_triangle(0, order, places);
  else
    add_square(0, order, places);
  std::vector<std::size_t> result;
  result.reserve(places.size());
  for (const auto& [i, j] : places) {
    // Row j of the triangle follows rows of order + 1, order, ... points.
    const int row = shape == mesh::Shape::triangle ? j * (order + 1) - j * (j - 1) / 2 : j * (order + 1);
    result.push_back(static_cast<std::size_t>(row + i));
  }
  return result;
}

std::size_t group_set(MeshData& data, std::vector<int> groups) {
  std::erase(groups, 0);
  std::ranges::sort(groups);
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  const auto [found, is_new] = data.set_numbers.emplace(std::move(groups), data.group_sets.size());
  if (is_new) data.group_sets.push_back(found->first);
  return found->second;
}

std::string checked_name(const geometry::TextFile& text, std::string_view name) {
  constexpr std::size_t longest = 127;
  if (name.empty()) text.refuse("a name is empty");
  if (name.size() > longest)
    text.refuse(fmt::format("the name \"{}\" is longer than {} bytes", geometry::shown(name), longest));
  if (!is_printable(name))
    text.refuse(fmt::format("the name \"{}\" has characters that cannot be printed", geometry::shown(name)));
  return std::string(name);
}

std::string place_of(const MeshElement& element) {
  return element.line > 0 ? fmt::format("element {} (line {})", element.tag, element.line)
                          : fmt::format("element {}", element.tag);
}

void number_nodes(MeshData& data) {
  std::ranges::sort(data.nodes, {}, &MeshNode::tag);
  const auto twice = std::ranges::adjacent_find(data.nodes, {}, &MeshNode::tag);
  if (twice != data.nodes.end())
    throw mesh::DomainError(fmt::format("{}: node {} stands twice, once at ({:g}, {:g})", data.source, twice->tag,
                                        twice->position[0], twice->position[1]));
  for (const MeshElement& element : data.elements) {
    const auto count = static_cast<std::size_t>(element_type(element.type)->nodes);
    for (std::size_t i = element.first_node; i < element.first_node + count; ++i) {
      std::int64_t& node = data.element_nodes[i];
      const auto found = std::ranges::lower_bound(data.nodes, node, {}, &MeshNode::tag);
      if (found == data.nodes.end() || found->tag != node)
        throw mesh::DomainError(
            fmt::format("{}: {} has the node {}, which does not exist", data.source, place_of(element), node));
      node = found - data.nodes.begin();
    }
  }
}

}  // namespace plastron::domain
