// The sections of Gmsh's mesh files that Plastron reads, in either version of the format (Gmsh reference manual, "MSH
// file format"). Each function begins behind the line that opens the section and ends behind its last entry.
#pragma once
#include <plastron/fem/element_type.hpp>
#include <plastron/fem/mesh_data.hpp>
#include <plastron/fem/mesh_text.hpp>

#include <map>
#include <string>
#include <utility>

namespace plastron::fem {

/// $PhysicalNames, alike in both versions.
void read_names(MeshText& text, MeshData& data);

/// Formats 2.0 to 2.2: an element has its group beside it, and stands once for each group it is in.
struct Version2 {
  MeshText& text;
  MeshData& data;

  void nodes();
  void elements();
};

/// Format 4.1: elements and nodes stand in blocks, one for each piece of the geometry, which has the groups.
struct Version4 {
  MeshText& text;
  MeshData& data;
  std::map<std::pair<int, int>, std::size_t> groups_of{};  ///< of (dimension, entity), in MeshData::group_sets

  void entities();
  void nodes();
  void elements();

 private:
  void entity(int dimension);
  void element_block();
};

/// One element's tag and nodes on the current line, the words in front of them read already.
void add_element(MeshText& text, MeshData& data, std::int64_t tag, int number, const ElementType& type,
                 std::size_t groups);
/// Refuses a number that is no element's.
ElementType known_type(const MeshText& text, std::int64_t number);

}  // namespace plastron::fem
