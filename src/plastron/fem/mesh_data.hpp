// The contents of a mesh file: nodes, elements, and the names of their physical groups.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace plastron::fem {

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
  std::vector<std::int64_t> element_nodes{};  ///< tags; indices into `nodes` after number_nodes()
  /// Physical groups of the elements' dimension, each set ascending. A negative number is the group of a line that is
  /// drawn in the opposite direction.
  std::vector<std::vector<int>> group_sets{{}};
  std::map<std::vector<int>, std::size_t> set_numbers{{{}, 0}};  ///< index of a set in `group_sets`
  std::map<std::pair<int, int>, std::string> names{};            ///< name by (dimension, group)
};

/// Replaces the tags of the elements' nodes by their indices. Throws DomainError for a tag that is duplicate or
/// missing.
void number_nodes(MeshData& data);

/// Returns "element 7 (line 31)".
std::string place_of(const MeshElement& element);

}  // namespace plastron::fem
