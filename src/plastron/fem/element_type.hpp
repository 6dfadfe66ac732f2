// The element types of Gmsh's mesh files by number: shape, order, and the order of their nodes. Corners come first,
// then sides, then the nodes inside as an element of lower order (Gmsh reference manual, "Node ordering").
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace plastron::fem {

enum class ElementFamily { point, line, triangle, quadrilateral, volume };

struct ElementType {
  ElementFamily family = ElementFamily::point;
  int order = 1;
  int nodes = 1;
  bool is_complete = true;  ///< true if it also has the nodes inside

  bool is_cell() const { return family == ElementFamily::triangle || family == ElementFamily::quadrilateral; }
  Shape shape() const { return family == ElementFamily::triangle ? Shape::triangle : Shape::quadrilateral; }
  /// Returns Gmsh's name: "Triangle 6".
  std::string name() const;
};

/// Returns the type of lines, triangles and quadrilaterals up to order 10; for other types only the family. Empty for
/// unknown numbers.
std::optional<ElementType> element_type(std::int64_t number);

/// Returns the index on lattice(shape, order) of each of Gmsh's nodes of a complete element.
std::vector<std::size_t> lattice_places(Shape shape, int order);

}  // namespace plastron::fem
