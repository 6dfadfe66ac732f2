// New triangles of nearly equal sides on a surface of facets. The triangles of a drawing program are often long and thin.
#pragma once
#include <plastron/facets/facets.hpp>

#include <memory>
#include <span>

namespace plastron::facets {

struct Remeshed {
  struct Line {
    std::array<int, 2> ends;  ///< points, in the direction of the curve
    int curve;                ///< index into Facets::curves
  };

  std::vector<Vector3d> points{};  ///< on the facets [m]
  std::vector<std::array<int, 3>> triangles{};
  std::vector<int> face_of{};  ///< of each triangle, index into Facets::faces
  std::vector<Line> lines{};   ///< sides of triangles on curves
};

/// Makes triangles with sides of about `length` [m], on the mean, with their corners on the facets. The sides on curves stay on them,
/// and the corners of the facets stay. Throws FileError with `name` in front if the surface cannot be meshed.
/// Isotropic remeshing by CGAL (Botsch and Kobbelt 2004): the same on every run.
Remeshed remesh(const Facets& facets, double length, const std::string& name);

/// Returns the facets themselves.
Remeshed as_they_are(const Facets& facets);

/// Finds the points of facets or of their curves that are nearest to given points.
class FacetProjection {
 public:
  /// Precondition: `facets` outlives this.
  explicit FacetProjection(const Facets& facets);
  ~FacetProjection();
  FacetProjection(const FacetProjection&) = delete;
  FacetProjection& operator=(const FacetProjection&) = delete;

  Vector3d on_facets(const Vector3d& point) const;
  Vector3d on_curve(const Vector3d& point, int curve) const;

 private:
  struct Tree;
  const Facets& facets_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace plastron::facets
