// The surface of facets that a file of triangles describes: triangles turned alike, smooth faces, and the curves where
// faces end.
#pragma once
#include <plastron/facets/triangles.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace plastron::facets {

/// Border: sides of one triangle. Fold: two triangles at an angle. Seam: two triangles of different groups that are
/// smooth.
enum class CurveKind { border, fold, seam };

/// A chain of sides of one kind without sharp bends, from point to point.
struct FacetCurve {
  std::string name;  ///< "edge 1", ...
  CurveKind kind = CurveKind::border;
  std::vector<std::array<int, 2>> sides{};  ///< each from the end of the one before
};

struct Facets {
  TriangleMesh mesh{};               ///< without triangles that have no area or occur twice
  std::vector<int> face_of{};        ///< of each triangle
  std::vector<std::string> faces{};  ///< names; all faces of a group have its name, others "surface 1", ...
  std::vector<FacetCurve> curves{};
  std::vector<int> corners{};  ///< points that every mesh of the surface must keep, ascending
  double smooth_angle = 0;     ///< limit between smooth sides and folds [rad]
  double largest_smooth = 0;   ///< largest angle within a face [rad]
  double mean_smooth = 0;      ///< mean angle at sides where facets within a face meet at one, by length [rad]
  double width = 0;       ///< mean distance of such sides: of facets in the direction of curvature [m]; 0: flat faces
  double least_fold = 0;  ///< least angle at a fold [rad]; 0 without folds
  std::size_t repeated = 0;  ///< triangles that occurred twice
  std::size_t flat = 0;      ///< triangles without area, given to their neighbours
  std::size_t turned = 0;    ///< triangles that were turned round
};

/// Finds the faces of a surface. Two triangles are smooth if the angle between their normals is at most `smooth_angle`
/// [rad] and they belong to one group. Throws FileError with `name` in front: more than two triangles at a side, a
/// surface with one side only, triangles without area that cannot be given to a neighbour.
Facets find_facets(TriangleMesh mesh, double smooth_angle, const std::string& name);

}  // namespace plastron::facets
