#include <plastron/domain/inp_cells.hpp>

#include <plastron/geometry/text_file.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::domain {

namespace {

using Indices = InpMembers::Indices;

/// The numbers of nodes or elements.
template <class Numbered>
Indices tags_of(const std::vector<Numbered>& all) {
  Indices tags;
  tags.reserve(all.size());
  for (const Numbered& one : all) tags.push_back(one.tag);
  return tags;
}

[[noreturn]] void refuse(const InpDeck& deck, const std::string& what) {
  throw mesh::DomainError(deck.path + ": " + what);
}

void check_content(const InpDeck& deck) {
  const auto has = [&](InpKind kind) {
    return std::ranges::any_of(deck.types, [&](const auto& t) { return t.type.kind == kind && t.count > 0; });
  };
  if (deck.nodes.empty()) refuse(deck, "it has no nodes (*NODE)");
  if (has(InpKind::cell)) return;
  if (has(InpKind::volume))
    refuse(deck, fmt::format("it has {}, which are volumes; a shell needs its mid-surface meshed with S4, S8, S3 or S6",
                             type_list(deck, [](InpKind kind) { return kind == InpKind::volume; })));
  const std::string others = type_list(deck, [](InpKind) { return true; });
  refuse(deck, fmt::format("it has no shell elements (*ELEMENT of type S3, S4, S6, S8 and the like){}",
                           others.empty() ? others : "; it has " + others));
}

void check_nodes_differ(const InpDeck& deck, const MeshData& data, const MeshElement& cell, int count) {
  const auto begin = data.element_nodes.begin() + static_cast<std::ptrdiff_t>(cell.first_node);
  std::vector<std::int64_t> nodes(begin, begin + count);
  std::ranges::sort(nodes);
  const auto twice = std::ranges::adjacent_find(nodes);
  if (twice != nodes.end())
    refuse(deck, fmt::format("{} has the node {} twice; {}", place_of(cell), *twice,
                             count == 4 ? "write a triangle as S3" : "the nodes of an element must differ"));
}

/// Returns the nodes of the file and the cells in its order.
MeshData read_cells(const InpDeck& deck) {
  MeshData data{.source = deck.path, .nodes = deck.nodes};
  for (const InpElement& element : deck.elements) {
    const InpElementType& type = deck.types[element.type].type;
    if (type.kind != InpKind::cell) continue;
    data.elements.push_back({element.tag, element.line, type.number, data.element_nodes.size()});
    const auto nodes = deck.element_nodes.begin() + static_cast<std::ptrdiff_t>(element.first_node);
    data.element_nodes.insert(data.element_nodes.end(), nodes, nodes + type.nodes);
    check_nodes_differ(deck, data, data.elements.back(), type.nodes);
  }
  number_nodes(data);
  return data;
}

/// Sorts the elements by their numbers. Returns the cell of each, -1 for elements of other kinds.
std::vector<std::int64_t> sort_elements(InpDeck& deck) {
  std::vector<std::pair<InpElement, std::int64_t>> sorted;  // with cells
  sorted.reserve(deck.elements.size());
  std::int64_t next_cell = 0;
  for (const InpElement& element : deck.elements)
    sorted.emplace_back(element, deck.types[element.type].type.kind == InpKind::cell ? next_cell++ : -1);
  std::ranges::stable_sort(sorted, {}, [](const auto& one) { return one.first.tag; });
  std::vector<std::int64_t> cell_of;
  cell_of.reserve(sorted.size());
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    const auto& [element, cell] = sorted[k];
    if (k > 0 && sorted[k - 1].first.tag == element.tag)
      refuse(deck, fmt::format("element {} stands twice, in line {} and in line {}", element.tag,
                               sorted[k - 1].first.line, element.line));
    deck.elements[k] = element;
    cell_of.push_back(cell);
  }
  return cell_of;
}

/// Gives quadrilaterals of 8 nodes their centre: half the sum of the middles of the sides minus a quarter of that of the
/// corners. It is the value of their eight polynomials there. These are of the nine of the complete element, so that the
/// surface is the same.
void complete_quadrilaterals(MeshData& data) {
  const std::size_t file_nodes = data.nodes.size();
  constexpr int of_eight_nodes = 16, complete = 10;
  const std::int64_t first = data.nodes.back().tag + 1;
  std::vector<std::int64_t> nodes;
  for (MeshElement& cell : data.elements) {
    const auto begin = data.element_nodes.begin() + static_cast<std::ptrdiff_t>(cell.first_node);
    const int count = element_type(cell.type)->nodes;
    cell.first_node = nodes.size();
    nodes.insert(nodes.end(), begin, begin + count);
    if (cell.type != of_eight_nodes) continue;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int i = 0; i < count; ++i) centre += (i < 4 ? -0.25 : 0.5) * data.nodes[begin[i]].position;
    const std::int64_t tag = data.nodes.back().tag + 1;
    nodes.push_back(static_cast<std::int64_t>(data.nodes.size()));
    data.nodes.push_back({tag, centre});
    cell.type = complete;
  }
  data.element_nodes = std::move(nodes);
  if (data.nodes.size() > file_nodes)
    data.notes.push_back(
        fmt::format("{} of 8 nodes: their centres are new nodes from number {} on, and their surface stays the same",
                    counted(data.nodes.size() - file_nodes, "quadrilateral"), first));
}

}  // namespace

InpCells::Indices InpCells::among(const Indices& numbers) const {
  Indices cells;
  for (const std::int64_t element : numbers)
    if (cell_of[element] >= 0) cells.push_back(cell_of[element]);
  return cells;
}

InpCells inp_cells(InpDeck& deck) {
  check_content(deck);
  MeshData data = read_cells(deck);
  const std::size_t file_nodes = data.nodes.size();
  Indices nodes = tags_of(data.nodes);
  complete_quadrilaterals(data);
  std::vector<std::int64_t> cell_of = sort_elements(deck);
  return {.data = std::move(data),
          .file_nodes = file_nodes,
          .cell_of = std::move(cell_of),
          .nodes = InpMembers(deck.node_sets, deck.path, "node", std::move(nodes)),
          .elements = InpMembers(deck.element_sets, deck.path, "element", tags_of(deck.elements))};
}

/// "3 elements of type S4, 1 of type MASS"
std::string type_list(const InpDeck& deck, bool (*is_wanted)(InpKind)) {
  std::string list;
  for (const InpDeck::Type& type : deck.types)
    if (type.count > 0 && is_wanted(type.type.kind) && list.size() < 200)
      list += fmt::format("{}{} {}of type {}", list.empty() ? "" : ", ", type.count,
                          !list.empty()     ? ""
                          : type.count == 1 ? "element "
                                            : "elements ",
                          geometry::shown(type.name));
  return list;
}

/// "1 node", "2 nodes"
std::string counted(std::size_t count, const char* noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace plastron::domain
