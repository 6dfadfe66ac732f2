// What a mesh in space consists of, for the writer of a case: regions, curves, folds. `plastron parts` prints these
// tables, and its page has them, too.
#pragma once
#include <plastron/domain/surface_mesh.hpp>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plastron::report {

struct RegionPart {
  std::string name;                   ///< empty: the file gives none
  std::size_t cells = 0, turned = 0;  ///< numbers; turned cells have the opposite orientation in the file
  double area = 0;                    ///< [m^2]
  Eigen::Vector3d middle;             ///< mean of the cells' middles, weighted by area [m]
  std::optional<Eigen::Vector3d> normal =
      {};  ///< unit vector along the integral of a3; empty: the normals cancel, as on a closed region
};

/// Regions in the order of FileSurface::regions.
std::vector<RegionPart> region_parts(const domain::FileSurface& surface);

/// Edges with one name, or edges of one kind without name.
struct CurvePart {
  std::string name;                    ///< by which a case refers to it; in brackets if a case cannot
  bool is_in_file = true;              ///< whether the name stands in the file; else the program gives it
  std::vector<std::size_t> edges{};    ///< indices of SurfaceTopology::edges
  std::array<std::size_t, 4> kinds{};  ///< number of edges by EdgeKind
  double length = 0;                   ///< of the polynomials of its edges [m]
  double largest_angle = 0;            ///< between the cells at an edge [rad]
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;  ///< bounding box [m]
  bool has_name() const { return !name.starts_with('('); }
};

/// The curves of the file, in the order of FileSurface::boundaries; then "fold 1", "fold 2", ... (surface_mesh()), then
/// borders without name, and folds that count as smooth.
std::vector<CurvePart> curve_parts(const domain::FileSurface& surface);

/// Edges to examine, indices of SurfaceTopology::edges: with an angle near the limit of smooth edges, and folds of a
/// single edge, which count as smooth.
std::vector<std::size_t> doubtful_edges(const topology::SurfaceTopology& topology);

// Texts of the tables.
std::string name_text(const RegionPart& region);
std::string normal_text(const RegionPart& region);
/// Returns "4 border, 2 fold".
std::string kinds_text(const CurvePart& curve);
/// Returns "border", "smooth", "fold" or "branch".
std::string_view kind_word(topology::EdgeKind kind);

}  // namespace plastron::report
