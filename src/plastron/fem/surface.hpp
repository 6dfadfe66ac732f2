// The mid-surface over a mesh, as a function of the cells' own coordinates (D3).
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/geometry/chart.hpp>
#include <plastron/geometry/frame.hpp>

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plastron::fem {

/// Returns the chart with the region's name, or the only chart if it has no name. Throws DomainError if there is
/// none.
const geometry::Chart& chart_of_region(const std::map<std::string, geometry::Chart>& charts, const std::string& region);

class Surface {
 public:
  /// Requires one chart per region name of the mesh, or no charts if the mesh lies in space. Throws DomainError for
  /// missing or unknown regions.
  Surface(std::shared_ptr<const mesh::CoarseMesh> coarse, const std::map<std::string, geometry::Chart>& charts);

  /// Points of Omega: the images of points xi of the reference cell; addresses on a mesh in space (address_of()).
  void positions(const Cell& cell, std::span<const Vector2d> xi, std::span<double> x, std::span<double> y) const;
  /// Frames in the cell's own coordinates (M1-M3), with the shifts of the coarse mesh. Without second derivatives da3 and b_cov
  /// have no meaning.
  void frames(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::Frame> frames,
              bool second_derivatives = true) const;
  geometry::Frame frame(const Cell& cell, const Vector2d& xi, bool second_derivatives = true) const;
  /// Places of the points for expressions. X, Y, Z are zero unless `in_space`.
  std::vector<geometry::Place> places(const Cell& cell, std::span<const Vector2d> xi, bool in_space) const;
  /// Sets values[p] to f at the place of xi[p].
  void evaluate(const geometry::Expression& f, const Cell& cell, std::span<const Vector2d> xi,
                std::span<double> values) const;
  /// Tangents that define the first axis of results: d phi/dx, or SurfacePatches::first_tangent. `frames` are the
  /// frames at the points.
  std::vector<geometry::Vector3d> first_tangents(const Cell& cell, std::span<const Vector2d> xi,
                                                 std::span<const geometry::Frame> frames) const;
  /// Jets of phi with respect to x and y of Omega at the same points. Precondition: the mesh lies in Omega.
  void parameter_jets(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::SurfaceJet> jets) const;

  const mesh::CoarseMesh& coarse() const { return *coarse_; }
  /// Whether the mesh lies in space. Its a3 is a director and not the normal of a chart.
  bool has_directors() const { return coarse_->patches != nullptr; }

 private:
  const geometry::Chart& chart_of(const Cell& cell) const;
  geometry::PlaneJet plane_jet(const Cell& cell, const Vector2d& xi) const;
  Vector2d address(const Cell& cell, const Vector2d& xi) const;
  void frames_without_shifts(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::Frame> frames,
                             bool second_derivatives) const;
  geometry::Frame shifted(const Cell& cell, const Vector2d& xi, const geometry::Frame& frame) const;

  std::shared_ptr<const mesh::CoarseMesh> coarse_;
  std::vector<geometry::Chart> charts_;  // by region index
};

/// Place of a point of Omega in the coarse mesh.
struct Location {
  int coarse;
  Vector2d xi;  ///< in the coarse cell's coordinates
};
/// Finds the point. Empty if it lies outside Omega.
std::optional<Location> locate(const mesh::CoarseMesh& coarse, const Vector2d& point);

/// A point of the mid-surface near a point in space.
struct NearestPoint {
  Location location;
  Vector2d point;            ///< in Omega
  geometry::Vector3d place;  ///< phi there [m]
  double distance;           ///< to the point in space [m]
};
/// Finds the nearest point of the mid-surface.
NearestPoint nearest_point(const Surface& surface, const geometry::Vector3d& point);
/// Finds the nearest node that all finer meshes contain too (kept_nodes()).
NearestPoint nearest_kept_node(const Surface& surface, int degree, const geometry::Vector3d& point);

/// Returns "x = 0.5, y = 1" for a point of Omega, or "(X, Y, Z) = (1, 2, 3)" on a mesh in space.
std::string place_text(const Surface& surface, const Vector2d& point);

/// Returns the point of the reference cell of `cell` for a location; empty if the cell does not contain it.
std::optional<Vector2d> local_coordinates(mesh::Shape shape, const Cell& cell, const Location& location);

}  // namespace plastron::fem
