// Reads Gmsh's mesh files, formats 2.0 to 2.2 and 4.1 as text. Gmsh itself would execute any file of unknown format
// as a script (docs/decisions/0008-mesh-files.md).
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/domain/mesh_data.hpp>
#include <plastron/domain/surface_mesh.hpp>
#include <plastron/geometry/text_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace plastron::domain {

namespace {

using geometry::shown;
using geometry::TextFile;

std::string quoted_name(const TextFile& text) {
  const std::string_view line = text.line();
  const std::size_t from = line.find('"'), to = line.rfind('"');
  if (from == std::string_view::npos || to <= from + 1)
    text.refuse(fmt::format("\"{}\" has no name in quotes", shown(line)));
  return checked_name(text, line.substr(from + 1, to - from - 1));
}

Eigen::Vector3d position(TextFile& text) {
  Eigen::Vector3d x;
  for (const int k : {0, 1, 2}) x[k] = text.real("a coordinate");
  return x;
}

/// Reads $PhysicalNames, which is the same in both versions.
void read_names(TextFile& text, MeshData& data) {
  text.expect_line("the number of names");
  const std::size_t count = text.count("the number of names", 6);
  for (std::size_t i = 0; i < count; ++i) {
    text.expect_line("a name");
    const int dimension = text.small_integer("a dimension"), group = text.small_integer("a physical group's number");
    if (!data.names.emplace(std::pair(dimension, group), quoted_name(text)).second)
      text.refuse(fmt::format("physical group {} of dimension {} has a name already", group, dimension));
  }
}

/// Returns the type with this number. Refuses a number that no element has.
ElementType known_type(const TextFile& text, std::int64_t number) {
  const auto type = element_type(number);
  if (!type) text.refuse(fmt::format("there are no elements of type {}", number));
  return *type;
}

/// Adds one element with its tag and nodes from the current line, after the preceding words were read.
void add_element(TextFile& text, MeshData& data, std::int64_t tag, int number, const ElementType& type,
                 std::size_t groups) {
  data.elements.push_back({tag, text.line_number(), number, data.element_nodes.size(), groups});
  const std::string what = fmt::format("one of the {} nodes of element {} ({})", type.nodes, tag, type.name());
  for (int i = 0; i < type.nodes; ++i) data.element_nodes.push_back(text.integer(what.c_str()));
  text.expect_end_of_line();
}

// The sections that Plastron reads (Gmsh reference manual, "MSH file format"). Each function starts after the line that
// opens the section and ends after its last entry.

/// Formats 2.0 to 2.2: an element contains its group, and occurs once for each of its groups.
struct Version2 {
  TextFile& text;
  MeshData& data;

  void nodes();
  void elements();
};

/// Format 4.1: elements and nodes are in blocks, one for each entity of the geometry. Groups belong to entities.
struct Version4 {
  TextFile& text;
  MeshData& data;
  std::map<std::pair<int, int>, std::size_t> groups_of{};  ///< index in MeshData::group_sets by (dimension, entity)

  void entities();
  void nodes();
  void elements();

 private:
  void entity(int dimension);
  void element_block();
};

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
    if (type.family == ElementFamily::volume) ++data.volumes;
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
  if (type.family == ElementFamily::volume) data.volumes += in_block;
  for (std::size_t i = 0; i < in_block; ++i) {
    text.expect_line("an element");
    const std::int64_t tag = text.integer("an element's number");
    if (type.is_cell() || type.family == ElementFamily::line)
      add_element(text, data, tag, number, type, groups == groups_of.end() ? 0 : groups->second);
  }
}

class Reader {
 public:
  explicit Reader(TextFile text) : text_(std::move(text)) { data_.source = text_.path(); }

  MeshData read() {
    const bool is_version_2 = header();
    if (is_version_2)
      sections(Version2{text_, data_});
    else
      sections(Version4{text_, data_});
    for (const char* needed : {"Nodes", "Elements"})
      if (!seen_.contains(needed))
        throw mesh::DomainError(fmt::format("{}: it has no section ${}", text_.path(), needed));
    check_volumes();
    number_nodes(data_);
    return std::move(data_);
  }

 private:
  /// Refuses the mesh of a solid: its triangles are the boundary of the solid and no mid-surface. Surfaces in physical groups
  /// were chosen.
  void check_volumes() {
    if (data_.volumes == 0) return;
    const bool chosen = std::ranges::any_of(data_.elements, [&](const MeshElement& element) {
      return element_type(element.type)->is_cell() && element.groups != 0;
    });
    if (!chosen)
      throw mesh::DomainError(fmt::format(
          "{}: it is the mesh of a solid, with {} volume elements; a shell is meshed on its mid-surface: save the "
          "surfaces of the shell as physical surfaces, without volumes (gmsh -2)",
          text_.path(), data_.volumes));
    data_.warnings.push_back(fmt::format(
        "the file has {} volume elements, which are not read: the shell consists of the physical surfaces, and has "
        "its own thickness",
        data_.volumes));
  }

  /// Reads the header. Returns true for version 2, false for version 4.
  bool header() {
    if (!text_.next_line()) throw mesh::DomainError(fmt::format("{}: the mesh file is empty", text_.path()));
    if (text_.line() == "$NOD")
      text_.refuse("it has Gmsh's format 1.0, which has no names; save the mesh in format 2.2 or 4.1");
    const bool is_step = text_.line().starts_with("ISO-10303-21");
    if (is_step || text_.line().starts_with("DBRep_") || text_.line().starts_with("CASCADE Topology"))
      text_.refuse(
          fmt::format("it is a {0} file and no mesh: let its name end with .{1}, and name it as file = \"part.{1}\" in "
                      "[geometry]",
                      is_step ? "STEP" : "BREP", is_step ? "step" : "brep"));
    if (text_.line() != "$MeshFormat")
      text_.refuse(
          fmt::format("it is no Gmsh mesh file: it begins with \"{}\" and not with $MeshFormat; save the mesh "
                      "as .msh",
                      shown(text_.line())));
    text_.expect_line("the version of the format");
    const std::string version(text_.word("the version of the format"));
    const std::int64_t is_binary = text_.integer("0 for text or 1 for binary");
    const bool is_version_2 = version == "2" || version == "2.0" || version == "2.1" || version == "2.2";
    if (!is_version_2 && version != "4.1")
      text_.refuse(
          fmt::format("its format has the version {}; 2.2 and 4.1 are read: save it with Mesh.MshFileVersion = "
                      "4.1",
                      shown(version)));
    if (is_binary != 0) text_.refuse("it is a binary file; save it as ASCII: Mesh.Binary = 0");
    end("MeshFormat");
    return is_version_2;
  }

  template <class Version>
  void sections(Version version) {
    while (text_.next_line()) {
      if (text_.line().front() != '$' || text_.line().starts_with("$End"))
        text_.refuse(fmt::format("found \"{}\" where a section should begin, like $Nodes", shown(text_.line())));
      const std::string name(text_.line().substr(1));
      if (!seen_.insert(name).second && is_read(name)) text_.refuse(fmt::format("there is a second section ${}", name));
      if (name == "PartitionedEntities")
        text_.refuse("the mesh is partitioned; save it whole, Plastron divides it itself");
      if (name == "Entities" && seen_.contains("Elements")) text_.refuse("$Entities must stand before $Elements");
      if (!read_section(version, name)) skip(name);
    }
  }

  static bool is_read(const std::string& name) {
    return name == "PhysicalNames" || name == "Nodes" || name == "Elements" || name == "Entities";
  }

  template <class Version>
  bool read_section(Version& version, const std::string& name) {
    if constexpr (std::is_same_v<Version, Version2>) {
      if (name == "Entities") return false;
    } else {
      if (name == "Entities") version.entities();
    }
    if (name == "PhysicalNames") read_names(text_, data_);
    if (name == "Nodes") version.nodes();
    if (name == "Elements") version.elements();
    if (name == "Notes") read_notes();
    if (name == "ElementNodeData" && !read_normals()) return false;
    if (!is_read(name) && name != "Notes" && name != "ElementNodeData") return false;
    end(name);
    return true;
  }

  /// Sentences for the user, in files that Plastron writes.
  void read_notes() {
    text_.expect_line("the number of notes");
    const std::size_t count = text_.count("the number of notes", 1);
    for (std::size_t i = 0; i < count; ++i) {
      text_.expect_line("a note");
      if (!is_printable(text_.line())) text_.refuse("a note has characters that cannot be printed");
      constexpr std::string_view warning = "warning: ";
      if (text_.line().starts_with(warning))
        data_.warnings.emplace_back(text_.line().substr(warning.size()));
      else
        data_.notes.emplace_back(text_.line());
    }
    text_.skip_rest_of_line();
  }

  /// Reads data of elements at their nodes with the name "normal": normals of the surface from which the mesh was made.
  /// Returns false if the section has other data.
  bool read_normals() {
    text_.expect_line("the number of names");
    const std::size_t names = text_.count("the number of names", 1);
    for (std::size_t i = 0; i < names; ++i) {
      text_.expect_line("a name");
      if (i == 0 && text_.line() != "\"normal\"") return false;
      text_.skip_rest_of_line();
    }
    text_.expect_line("the number of real numbers");
    const std::size_t reals = text_.count("the number of real numbers", 1);
    for (std::size_t i = 0; i < reals; ++i) {
      text_.expect_line("a number");
      text_.real("a number");
    }
    text_.expect_line("the number of whole numbers");
    const std::size_t integers = text_.count("the number of whole numbers", 1);
    std::int64_t components = 0;
    std::size_t elements = 0;
    for (std::size_t i = 0; i < integers; ++i) {
      text_.expect_line("a number");
      if (i == 2)
        elements = text_.count("the number of elements with normals", 8);
      else if (const std::int64_t number = text_.integer("a number"); i == 1)
        components = number;
    }
    if (components != 3) text_.refuse("normals have three components each");
    std::map<std::int64_t, const MeshElement*> by_tag;
    for (const MeshElement& element : data_.elements)
      if (element_type(element.type)->is_cell()) by_tag[element.tag] = &element;
    data_.element_normals.assign(data_.element_nodes.size(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < elements; ++i) {
      text_.expect_line("the normals of an element");
      const std::int64_t tag = text_.integer("an element's number");
      const auto found = by_tag.find(tag);
      if (found == by_tag.end())
        text_.refuse(fmt::format("there are normals of element {}, which is no cell of the file", tag));
      const MeshElement& element = *found->second;
      const int nodes = element_type(element.type)->nodes;
      if (text_.integer("a number of nodes") != nodes)
        text_.refuse(fmt::format("element {} has {} nodes, and another number of normals", tag, nodes));
      for (int n = 0; n < nodes; ++n)
        data_.element_normals[element.first_node + static_cast<std::size_t>(n)] = position(text_);
      text_.expect_end_of_line();
    }
    return true;
  }

  void end(const std::string& name) {
    const std::string line = "$End" + name;
    text_.expect_line(line.c_str());
    if (text_.line() != line)
      text_.refuse(fmt::format("found \"{}\" where {} should follow", shown(text_.line()), line));
  }

  void skip(const std::string& name) {
    const std::size_t opened = text_.line_number();
    while (text_.next_line())
      if (text_.line().starts_with("$End") && text_.line().substr(4) == name) return;
    text_.refuse(fmt::format("the section ${}, opened in line {}, has no end", shown(name), opened));
  }

  TextFile text_;
  MeshData data_;
  std::set<std::string> seen_;
};

}  // namespace

namespace {

template <class... Arguments>
MeshData read_msh(Arguments&&... arguments) {
  try {
    return Reader(TextFile(std::forward<Arguments>(arguments)...)).read();
  } catch (const geometry::FileError& error) {
    throw mesh::DomainError(error.what());
  }
}

}  // namespace

MeshData read_msh_file(const std::string& path) { return read_msh(path, "mesh file", geometry::Lines::end_words); }

MeshData read_msh_text(const std::string& path, std::string text) {
  MeshData data = read_msh(path, std::move(text), geometry::Lines::end_words, std::in_place);
  for (MeshElement& element : data.elements) element.line = 0;  // of a file that the user does not see
  return data;
}

mesh::CoarseMesh read_mesh_file(const MeshFile& file, mesh::Shape shape) {
  if (file.in_space) return surface_mesh(read_surface(file, shape), shape);
  return build_coarse_mesh(read_msh_file(file.path), shape);
}

}  // namespace plastron::domain
