// The parameter domains Omega that a case can name. A domain is only a description; domain_mesh.hpp meshes it.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plastron::mesh {
struct CoarseMesh;
}

namespace plastron::domain {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

/// Distance of the mid-surface from the surface of a file, along a_3, as a part of the thickness.
struct Offset {
  double part = 0;
  geometry::Expression thickness{1.0};                      ///< of regions without their own [m]
  std::map<std::string, geometry::Expression> by_region{};  ///< thickness by name of region [m]

  const geometry::Expression& thickness_of(const std::string& region) const {
    const auto own = by_region.find(region);
    return own == by_region.end() ? thickness : own->second;
  }
};

/// How the cells of a file become a mid-surface in space.
struct SpaceReading {
  double scale = 1;                 ///< factor from the lengths of the file to the lengths of the case
  double file_unit = 0;             ///< unit of the lengths of a CAD file [m]; 0: the one that the file names
  std::optional<Vector3d> upper{};  ///< side to which a_3 points; else outwards, or as in the file
  /// Largest angle of an edge that is no fold [rad]; default by the order of the cells.
  std::optional<double> smooth_angle{};
  std::vector<std::string> folds{};      ///< names of curves that are folds at any angle
  std::optional<double> size{};          ///< sides of the cells that are made from facets [m]; default: from the area
  std::optional<double> tolerance{};     ///< nodes nearer than this are one node [m]; default: rounding
  std::vector<std::string> symmetric{};  ///< boundaries in planes of symmetry, in which their directors lie
  Offset offset{};
  bool has_slits = false;  ///< whether edges may run beside each other without being joined
};

/// The mesh of a CAD file: its cells have positions and normals of the part, which is not asked again.
struct FrozenMesh {
  std::string text{};     ///< of a .msh file
  std::string failure{};  ///< why there is none
};

/// A file of quadrilaterals or triangles (order 1 or higher): Gmsh's .msh; in space also .inp of Abaqus and CalculiX,
/// facets (.stl, .obj, .ply), which are remeshed, and CAD files (.step, .stp, .brep), which are meshed.
/// Physical curves name the boundaries, physical surfaces the regions.
struct MeshFile {
  std::string path;
  std::optional<SpaceReading>
      in_space{};         ///< set if the cells are the mid-surface; else they lie in the plane of Omega
  std::string cad_job{};  ///< of a CAD file: the job of plastron-cad, as JSON (apps/cad/job.hpp)
  std::shared_ptr<const FrozenMesh> frozen{};  ///< of a CAD file, if already made (with_shared_mesh, or kept results)
  /// Mesh if already read (with_shared_mesh); otherwise coarse_mesh() reads the file.
  std::shared_ptr<const mesh::CoarseMesh> mesh{};
};

/// Whether the name of the file ends with .step, .stp or .brep.
bool is_cad_file(const std::string& path);

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

}  // namespace plastron::domain
