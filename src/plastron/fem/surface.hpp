// The mid-surface over a mesh: the chart of each region seen from the cells' own coordinates (D3).
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

/// The chart of a region: the one of its name, or the only one there is if that has no name. Throws DomainError if there is none.
const geometry::Chart& chart_of_region(const std::map<std::string, geometry::Chart>& charts, const std::string& region);

class Surface {
 public:
  /// One chart per region name of the mesh. Throws DomainError for missing or unknown regions.
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

/// Where a point of Omega lies in the coarse mesh.
struct Location {
  int coarse;
  Vector2d xi;  ///< in the coarse cell's coordinates
};
/// Empty if the point lies outside of Omega.
std::optional<Location> locate(const CoarseMesh& coarse, const Vector2d& point);

/// The point of the reference cell that `cell` has at a location; empty if the cell does not hold it.
std::optional<Vector2d> local_coordinates(Shape shape, const Cell& cell, const Location& location);

}  // namespace plastron::fem
