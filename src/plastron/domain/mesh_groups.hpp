// The named groups of a mesh file: groups of cells are regions, groups of lines are boundaries.
#pragma once
#include <plastron/domain/mesh_data.hpp>

#include <map>
#include <string>
#include <vector>

namespace plastron::domain {

class MeshGroups {
 public:
  enum class Nameless { refused, numbered };

  /// Collects the names of the groups that contain elements. Groups with the same name are one group. A group without
  /// name is refused by a DomainError, or has its number as its name.
  MeshGroups(const MeshData& data, Nameless nameless);

  const std::vector<std::string>& regions() const { return regions_; }  ///< {""} without groups of cells
  const std::vector<std::string>& boundaries() const { return boundaries_; }
  /// Returns the region of a cell. Throws DomainError if it is in none, though others are, or in two.
  int region(const MeshElement& cell) const;
  /// Returns the boundary of a group of a line.
  int boundary(int group) const { return boundary_of_.at(std::abs(group)); }

 private:
  std::map<int, int> name_groups(int dimension, Nameless nameless, std::vector<std::string>& names) const;
  std::string name_of(int dimension, int group, Nameless nameless) const;

  const MeshData& data_;
  std::vector<std::string> regions_{}, boundaries_{};
  std::map<int, int> region_of_{}, boundary_of_{};
};

/// Throws DomainError unless elements of this type may become cells of the shape.
void check_cell_type(const MeshData& data, const ElementType& type, mesh::Shape shape);
/// Throws DomainError: the file has no cells for the shape.
[[noreturn]] void refuse_without_cells(const MeshData& data, mesh::Shape shape);
/// Throws DomainError: a line element is no side of a cell.
[[noreturn]] void refuse_line(const MeshData& data, const MeshElement& line, const std::string& boundary);

}  // namespace plastron::domain
