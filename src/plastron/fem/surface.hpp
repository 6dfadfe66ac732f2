// The mid-surface over a mesh: each region's chart as a function of the cells' own coordinates (D3).
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/geometry/chart.hpp>

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
  /// Requires one chart per region name of the mesh. Throws DomainError for missing or unknown regions.
  Surface(std::shared_ptr<const CoarseMesh> coarse, const std::map<std::string, geometry::Chart>& charts);

  /// Points of Omega: the images of points xi of the reference cell.
  void positions(const Cell& cell, std::span<const Vector2d> xi, std::span<double> x, std::span<double> y) const;
  /// Jets of phi with respect to the cell's own coordinates.
  void jets(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::SurfaceJet> jets,
            bool second_derivatives = true) const;
  /// Jets of phi with respect to x and y of Omega at the same points.
  void parameter_jets(const Cell& cell, std::span<const Vector2d> xi, std::span<geometry::SurfaceJet> jets) const;

  const CoarseMesh& coarse() const { return *coarse_; }

 private:
  const geometry::Chart& chart_of(const Cell& cell) const;
  PlaneJet plane_jet(const Cell& cell, const Vector2d& xi) const;

  std::shared_ptr<const CoarseMesh> coarse_;
  std::vector<geometry::Chart> charts_;  // by region index
};

/// Place of a point of Omega in the coarse mesh.
struct Location {
  int coarse;
  Vector2d xi;  ///< in the coarse cell's coordinates
};
/// Finds the point. Empty if it lies outside Omega.
std::optional<Location> locate(const CoarseMesh& coarse, const Vector2d& point);

/// Returns the point of the reference cell of `cell` for a location; empty if the cell does not contain it.
std::optional<Vector2d> local_coordinates(Shape shape, const Cell& cell, const Location& location);

}  // namespace plastron::fem
