#include <plastron/fem/mesh_sections.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace plastron::fem {

namespace {

/// Whether the bytes are UTF-8 without control characters. Names are written to results and to the terminal.
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

std::string quoted_name(MeshText& text) {
  constexpr std::size_t longest = 127;  // Gmsh's own limit
  const std::string_view line = text.line();
  const std::size_t from = line.find('"'), to = line.rfind('"');
  if (from == std::string_view::npos || to <= from + 1)
    text.refuse(fmt::format("\"{}\" has no name in quotes", shown(line)));
  const std::string_view name = line.substr(from + 1, to - from - 1);
  if (name.size() > longest) text.refuse(fmt::format("the name \"{}\" is longer than {} bytes", shown(name), longest));
  if (!is_printable(name))
    text.refuse(fmt::format("the name \"{}\" has characters that cannot be printed", shown(name)));
  return std::string(name);
}

Eigen::Vector3d position(MeshText& text) {
  Eigen::Vector3d x;
  for (const int k : {0, 1, 2}) x[k] = text.real("a coordinate");
  return x;
}

/// Returns the index of a set of groups, which is stored once. Group 0 means none.
std::size_t group_set(MeshData& data, std::vector<int> groups) {
  std::erase(groups, 0);
  std::ranges::sort(groups);
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  const auto [found, is_new] = data.set_numbers.emplace(std::move(groups), data.group_sets.size());
  if (is_new) data.group_sets.push_back(found->first);
  return found->second;
}

}  // namespace

void read_names(MeshText& text, MeshData& data) {
  text.expect_line("the number of names");
  const std::size_t count = text.count("the number of names", 6);
  for (std::size_t i = 0; i < count; ++i) {
    text.expect_line("a name");
    const int dimension = text.small_integer("a dimension"), group = text.small_integer("a physical group's number");
    if (!data.names.emplace(std::pair(dimension, group), quoted_name(text)).second)
      text.refuse(fmt::format("physical group {} of dimension {} has a name already", group, dimension));
  }
}

ElementType known_type(const MeshText& text, std::int64_t number) {
  const auto type = element_type(number);
  if (!type) text.refuse(fmt::format("there are no elements of type {}", number));
  return *type;
}

void add_element(MeshText& text, MeshData& data, std::int64_t tag, int number, const ElementType& type,
                 std::size_t groups) {
  data.elements.push_back({tag, text.line_number(), number, data.element_nodes.size(), groups});
  const std::string what = fmt::format("one of the {} nodes of element {} ({})", type.nodes, tag, type.name());
  for (int i = 0; i < type.nodes; ++i) data.element_nodes.push_back(text.integer(what.c_str()));
  text.expect_end_of_line();
}

void Version2::nodes() {
  text.expect_line("the number of nodes");
  const std::size_t count = text.count("the number of nodes", 8);
  for (std::size_t i = 0; i < count; ++i) {
    text.expect_line("a node");
    const std::int64_t tag = text.integer("a node's number");
    data.nodes.push_back({tag, position(text)});
    text.expect_end_of_line();
  }
}

void Version2::elements() {
  text.expect_line("the number of elements");
  const std::size_t count = text.count("the number of elements", 8);
  for (std::size_t i = 0; i < count; ++i) {
    text.expect_line("an element");
    const std::int64_t tag = text.integer("an element's number");
    const int number = text.small_integer("an element's type");
    const ElementType type = known_type(text, number);
    const int tags = text.small_integer("the number of an element's tags");
    int group = 0;
    for (int k = 0; k < tags; ++k) {
      const std::int64_t of_element = text.integer("an element's tag");
      if (k == 0) group = static_cast<int>(std::clamp<std::int64_t>(of_element, -0x7fffffff, 0x7fffffff));
    }
    if (type.is_cell() || type.family == ElementFamily::line)
      add_element(text, data, tag, number, type, group_set(data, {group}));
  }
}

void Version4::entities() {
  text.expect_line("the numbers of entities");
  std::size_t count[4];
  for (std::size_t& n : count) n = text.count("a number of entities", 8);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < count[dimension]; ++i) entity(dimension);
}

void Version4::entity(int dimension) {
  text.expect_line("an entity");
  const int tag = text.small_integer("an entity's number");
  for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) text.real("a coordinate");
  std::vector<int> groups;
  const std::size_t count = text.count("the number of physical groups", 1);
  for (std::size_t i = 0; i < count; ++i) groups.push_back(text.small_integer("a physical group's number"));
  if (!groups_of.emplace(std::pair(dimension, tag), group_set(data, std::move(groups))).second)
    text.refuse(fmt::format("entity {} of dimension {} stands twice", tag, dimension));
}

void Version4::nodes() {
  text.expect_line("the numbers of blocks and nodes");
  const std::size_t blocks = text.count("the number of blocks", 8), count = text.count("the number of nodes", 8);
  for (std::size_t b = 0; b < blocks; ++b) {
    text.expect_line("a block of nodes");
    for (const char* what : {"a dimension", "an entity's number", "whether there are parameters"}) text.integer(what);
    const std::size_t in_block = text.count("the number of nodes of a block", 2), first = data.nodes.size();
    if (in_block > count - first) text.refuse(fmt::format("the blocks have more than the {} nodes given", count));
    for (std::size_t i = 0; i < in_block; ++i) {
      text.expect_line("a node's number");
      data.nodes.push_back({.tag = text.integer("a node's number")});
    }
    for (std::size_t i = first; i < data.nodes.size(); ++i) {
      text.expect_line("a node's coordinates");
      data.nodes[i].position = position(text);
    }
  }
}

void Version4::elements() {
  text.expect_line("the numbers of blocks and elements");
  const std::size_t blocks = text.count("the number of blocks", 8);
  for (std::size_t b = 0; b < blocks; ++b) element_block();
}

void Version4::element_block() {
  text.expect_line("a block of elements");
  const int dimension = text.small_integer("a dimension"), entity = text.small_integer("an entity's number");
  const int number = text.small_integer("an element type");
  const ElementType type = known_type(text, number);
  const int expected = type.is_cell() ? 2 : type.family == ElementFamily::line ? 1 : dimension;
  if (dimension != expected)
    text.refuse(fmt::format("elements of type \"{}\" stand in a block of dimension {}", type.name(), dimension));
  const std::size_t in_block = text.count("the number of elements of a block", 4);
  const auto groups = groups_of.find({dimension, entity});
  for (std::size_t i = 0; i < in_block; ++i) {
    text.expect_line("an element");
    const std::int64_t tag = text.integer("an element's number");
    if (type.is_cell() || type.family == ElementFamily::line)
      add_element(text, data, tag, number, type, groups == groups_of.end() ? 0 : groups->second);
  }
}

}  // namespace plastron::fem
