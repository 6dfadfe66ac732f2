// The mesh of an Abaqus or CalculiX input file as written: nodes, elements, sets, surfaces, normals, sections.
#pragma once
#include <plastron/domain/mesh_data.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::domain {

enum class InpKind { cell, line, volume, other };

struct InpElementType {
  InpKind kind = InpKind::other;
  int nodes =
      0;  ///< 0: unknown. An element of a line or another kind ends with the first line without a comma at its end
  int number = 0;         ///< Gmsh's number of a cell
  bool is_plane = false;  ///< plane stress or strain: a surface's labels S1, S2, ... are sides 1, 2, ...
};

/// Returns the type of a name in capitals: "S8R". Corners come first, then the middles of the sides, then the centre:
/// this is Gmsh's order, too.
InpElementType inp_element_type(std::string_view name);

/// Node and element numbers, and names of sets, belong to the part or to the assembly: both may have a set "Set-1". A
/// file without parts is one part.
enum class InpLevel { part, assembly };

/// The name of a set where the file uses it.
struct InpUse {
  std::string name{};               ///< in capitals
  InpLevel level = InpLevel::part;  ///< where the search begins
  std::size_t line = 0;
};

/// A member of a set: a number, or all members of another set.
struct InpMember {
  std::int64_t number = 0;  ///< 0: the set
  InpUse set{};
};

/// The numbers first, first + step, ... up to last.
struct InpRange {
  std::int64_t first = 0, last = 0, step = 1;
};

struct InpSet {
  std::string name{};  ///< as first written
  InpLevel level = InpLevel::part;
  bool is_internal = false;  ///< made by Abaqus/CAE for its own use
  bool is_listed = false;    ///< has a block of its own, and is not only a parameter of *NODE or *ELEMENT
  std::vector<InpRange> ranges{};
  std::vector<InpUse> sets{};
  std::vector<InpUse> nodes_of{};  ///< for a set of nodes: sets of elements whose nodes it contains

  void add(std::int64_t number);
};

/// Sets of nodes or of elements in the order of the file. Names that differ only by capitals are one set.
struct InpSets {
  std::vector<InpSet> all{};
  std::map<std::pair<InpLevel, std::string>, std::size_t> number_of{};  ///< index in `all` by level and capitals

  /// Returns the set, which is new if there is none.
  InpSet& at(InpLevel level, const std::string& name);
};

struct InpSurface {
  struct Entry {
    InpMember elements{};
    std::string label{};  ///< "SPOS", "E2"; empty: whole elements
    std::size_t line = 0;
  };
  std::string name{};
  InpLevel level = InpLevel::part;
  std::vector<Entry> entries{};
};

struct InpNormal {
  InpMember elements{}, nodes{};
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

struct InpElement {
  std::int64_t tag = 0;
  std::size_t line = 0;
  std::size_t type = 0;        ///< index in InpDeck::types
  std::size_t first_node = 0;  ///< index in InpDeck::element_nodes, which has nodes of cells and lines only
  std::size_t nodes = 0;
};

struct InpDeck {
  struct Type {
    std::string name{};
    InpElementType type{};
    std::size_t count = 0;
  };

  std::string path{};
  std::vector<MeshNode> nodes{};
  std::vector<std::pair<std::int64_t, Eigen::Vector3d>> node_normals{};  ///< node's number, direction
  std::vector<Type> types{};
  std::vector<InpElement> elements{};
  std::vector<std::int64_t> element_nodes{};
  InpSets node_sets{}, element_sets{}, node_surfaces{};
  std::vector<InpSurface> surfaces{};
  std::vector<InpNormal> normals{};
  std::vector<InpUse> sections{};       ///< sets of elements that have a section of shells
  std::map<std::string, int> unread{};  ///< number of blocks by keyword
  std::vector<std::string> notes{};
  std::string instance{};          ///< name of the instance; empty if there is none
  std::size_t assembly_nodes = 0;  ///< nodes of the assembly, like reference points
};

/// Reads the file. Throws FileError or DomainError for wrong syntax and for keywords that would leave the mesh
/// incomplete.
InpDeck read_inp_deck(const std::string& path);

}  // namespace plastron::domain
