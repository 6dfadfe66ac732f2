// The parameter domains Omega that a case can name. A domain is only a description; coarse_mesh.hpp meshes it.
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace plastron::fem {

using Eigen::Vector2d;

struct CoarseMesh;

/// Boundaries: left, right, bottom, top (x min, x max, y min, y max).
struct Rectangle {
  Vector2d from = Vector2d::Zero(), to = Vector2d::Ones();
  std::array<int, 2> cells{0, 0};      ///< cells of the coarsest mesh; 0: nearly square, at most 8 along a side
  std::vector<double> breaks{};        ///< ascending x between from and to at the borders of regions
  std::vector<std::string> regions{};  ///< names from left to right, one more than breaks; empty: one region ""
};

/// Boundary: rim.
struct Disk {
  Vector2d centre = Vector2d::Zero();
  double radius = 1;
};

/// Boundaries: inner, outer.
struct Annulus {
  Vector2d centre = Vector2d::Zero();
  double inner = 0.5, outer = 1;
};

/// A simple polygon with corners in either orientation. Boundaries: edge1 (from corner 1 to corner 2), edge2, ...
struct Polygon {
  std::vector<Vector2d> corners;
};

/// A Gmsh file of quadrilaterals or triangles (order 1 or higher, complete) in the parameter plane. Physical curves
/// name the boundaries, physical surfaces the regions.
struct MeshFile {
  std::string path;
  /// Mesh if already read (with_shared_mesh); otherwise coarse_mesh() reads the file.
  std::shared_ptr<const CoarseMesh> mesh{};
};

using Domain = std::variant<Rectangle, Disk, Annulus, Polygon, MeshFile>;

/// The boundary names of a built-in domain; empty for a mesh file, whose names are read with the mesh.
std::vector<std::string> boundary_names(const Domain& domain);
/// The region names; {""} for a domain of one unnamed region, empty for a mesh file.
std::vector<std::string> region_names(const Domain& domain);

/// The area of a polygon, positive if the corners run anticlockwise.
double signed_area(const Polygon& polygon);
double perimeter(const Polygon& polygon);
/// Twice the area over the perimeter: the radius of the inscribed circle if one touches all sides.
double inner_width(const Polygon& polygon);
/// Whether the polygon is a convex quadrilateral without nearly straight corners.
bool is_convex_quadrilateral(const Polygon& polygon);

/// Error in a domain or mesh file; its text is shown to the user unchanged.
struct DomainError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

}  // namespace plastron::fem
