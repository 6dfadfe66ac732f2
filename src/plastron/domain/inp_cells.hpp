// The shell elements of an Abaqus or CalculiX input file as cells of a mesh.
#pragma once
#include <plastron/domain/inp_sets.hpp>

namespace plastron::domain {

struct InpCells {
  using Indices = InpMembers::Indices;

  MeshData data{};                      ///< the elements are the cells in the order of the file; no names yet
  std::size_t file_nodes = 0;           ///< nodes of the file; centres of cells follow
  std::vector<std::int64_t> cell_of{};  ///< index in MeshData::elements by index in InpDeck::elements; -1: no cell
  InpMembers nodes, elements;           ///< the members of the deck's sets, which must outlive this object

  /// Returns the cells among the elements of these indices.
  Indices among(const Indices& numbers) const;
};

/// Reads the cells, and sorts InpDeck::elements by their numbers. A quadrilateral of 8 nodes gets its centre. Throws
/// DomainError for a file without shell elements and for nodes or elements that stand twice.
InpCells inp_cells(InpDeck& deck);

/// Returns "3 elements of type S4, 1 of type MASS".
std::string type_list(const InpDeck& deck, bool (*is_wanted)(InpKind));
/// Returns "1 node", "2 nodes".
std::string counted(std::size_t count, const char* noun);

}  // namespace plastron::domain
