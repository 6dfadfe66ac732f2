// The sections of Gmsh's mesh files that Plastron reads, in both versions of the format (Gmsh reference manual, "MSH
// file format"). Each function starts after the line that opens the section and ends after its last entry.
#pragma once
#include <plastron/fem/element_type.hpp>
#include <plastron/fem/mesh_data.hpp>
#include <plastron/fem/mesh_text.hpp>

#include <map>
#include <string>
#include <utility>

namespace plastron::fem {

/// Reads $PhysicalNames, which is the same in both versions.
void read_names(MeshText& text, MeshData& data);

/// Formats 2.0 to 2.2: an element contains its group, and occurs once for each of its groups.
struct Version2 {
  MeshText& text;
  MeshData& data;

  void nodes();
  void elements();
};

/// Format 4.1: elements and nodes are in blocks, one for each entity of the geometry. Groups belong to entities.
struct Version4 {
  MeshText& text;
  MeshData& data;
  std::map<std::pair<int, int>, std::size_t> groups_of{};  ///< index in MeshData::group_sets by (dimension, entity)

  void entities();
  void nodes();
  void elements();

 private:
  void entity(int dimension);
  void element_block();
};

/// Adds one element with its tag and nodes from the current line, after the preceding words were read.
void add_element(MeshText& text, MeshData& data, std::int64_t tag, int number, const ElementType& type,
                 std::size_t groups);
/// Returns the type with this number. Refuses a number that no element has.
ElementType known_type(const MeshText& text, std::int64_t number);

}  // namespace plastron::fem
