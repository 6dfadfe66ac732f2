// The contents of a mesh file: element types, nodes, elements, and the names of their physical groups.
#pragma once
#include <plastron/mesh/coarse_mesh.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::geometry {
class TextFile;
}

namespace plastron::domain {

// The element types of Gmsh's mesh files by number: shape, order, and the order of their nodes. Corners come first,
// then sides, then the nodes inside as an element of lower order (Gmsh reference manual, "Node ordering").

enum class ElementFamily { point, line, triangle, quadrilateral, volume };

struct ElementType {
  ElementFamily family = ElementFamily::point;
  int order = 1;
  int nodes = 1;
  bool is_complete = true;  ///< true if it also has the nodes inside

  bool is_cell() const { return family == ElementFamily::triangle || family == ElementFamily::quadrilateral; }
  mesh::Shape shape() const {
    return family == ElementFamily::triangle ? mesh::Shape::triangle : mesh::Shape::quadrilateral;
  }
  /// Returns Gmsh's name: "Triangle 6".
  std::string name() const;
};

/// Returns the type of lines, triangles and quadrilaterals up to order 10; for other types only the family. Empty for
/// unknown numbers.
std::optional<ElementType> element_type(std::int64_t number);

/// Returns the number of the complete element of an order from 1 to 10.
int element_number(ElementFamily family, int order);

/// Returns the index on lattice(shape, order) of each of Gmsh's nodes of a complete element.
std::vector<std::size_t> lattice_places(mesh::Shape shape, int order);

struct MeshNode {
  std::int64_t tag = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// A line, triangle or quadrilateral; other elements are left out.
struct MeshElement {
  std::int64_t tag = 0;
  std::size_t line = 0;        ///< line of the file; 0: not from a file
  int type = 1;                ///< Gmsh's number
  std::size_t first_node = 0;  ///< index in MeshData::element_nodes
  std::size_t groups = 0;      ///< index in MeshData::group_sets
};

struct MeshData {
  std::string source{};  ///< start of every message
  std::vector<MeshNode> nodes{};
  std::vector<MeshElement> elements{};
  std::size_t volumes = 0;                    ///< number of elements that are volumes
  std::vector<std::int64_t> element_nodes{};  ///< tags; indices into `nodes` after number_nodes()
  /// Physical groups of the elements' dimension, each set ascending. A negative number is the group of a line that is
  /// drawn in the opposite direction.
  std::vector<std::vector<int>> group_sets{{}};
  std::map<std::vector<int>, std::size_t> set_numbers{{{}, 0}};  ///< index of a set in `group_sets`
  std::map<std::pair<int, int>, std::string> names{};            ///< name by (dimension, group)
  /// Unit normals of the surface at nodes, given by the file: one entry for each node, or none at all.
  std::vector<std::optional<Eigen::Vector3d>> normals{};
  /// Normals of the surface at the nodes of each element, as `element_nodes`; zero: not given. Empty if the file gives no normals.
  std::vector<Eigen::Vector3d> element_normals{};
  std::map<std::string, std::vector<std::int64_t>> point_sets{};  ///< named points: indices into `nodes`
  std::vector<std::string> notes{};     ///< for the user: contents of the file that are not read, one sentence each
  std::vector<std::string> warnings{};  ///< for the user: flaws of the file that can be computed with
};

/// Reads a .msh file of Gmsh, format 2.0 to 2.2 or 4.1 as text. Throws DomainError with the file, the line and the
/// mistake.
MeshData read_msh_file(const std::string& path);
/// The same for the text of a file; `path` names it in messages.
MeshData read_msh_text(const std::string& path, std::string text);
/// Reads the mesh of an Abaqus or CalculiX input file (inp_file.cc has the rules). Throws DomainError with the file, the
/// line and the mistake.
MeshData read_inp_file(const std::string& path);

/// Returns the index of a set of groups, which is stored once. Group 0 means none.
std::size_t group_set(MeshData& data, std::vector<int> groups);

/// Returns true if the bytes are UTF-8 without control characters.
bool is_printable(std::string_view text);

/// Returns the name. Refuses a name that is empty, longer than 127 bytes (Gmsh's limit), or not printable UTF-8: names
/// are written to results and to the terminal.
std::string checked_name(const geometry::TextFile& text, std::string_view name);

/// Replaces the tags of the elements' nodes by their indices. Throws DomainError for a tag that is duplicate or
/// missing.
void number_nodes(MeshData& data);

/// Returns "element 7 (line 31)".
std::string place_of(const MeshElement& element);

/// Builds the coarse mesh: cells with exact maps, named regions and boundaries. Throws DomainError for elements that
/// `shape` does not allow, and for data that is no mesh of the plane.
mesh::CoarseMesh build_coarse_mesh(const MeshData& data, mesh::Shape shape);

}  // namespace plastron::domain
