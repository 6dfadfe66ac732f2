// The element types of Gmsh's mesh files by their number: what shape, which order, and in which order their nodes stand
// (Gmsh reference manual, "Node ordering": corners, then sides, then the nodes inside as an element of lower order).
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
  bool is_complete = true;  ///< has the nodes inside, too

  bool is_cell() const { return family == ElementFamily::triangle || family == ElementFamily::quadrilateral; }
  Shape shape() const { return family == ElementFamily::triangle ? Shape::triangle : Shape::quadrilateral; }
  /// As Gmsh calls it: "Triangle 6".
  std::string name() const;
};

/// Lines, triangles and quadrilaterals up to order 10; of other types the family only. Empty for unknown numbers.
std::optional<ElementType> element_type(std::int64_t number);

/// The place of each of Gmsh's nodes of a complete element on lattice(shape, order).
std::vector<std::size_t> lattice_places(Shape shape, int order);

}  // namespace plastron::fem
