// Stress resultants smoothed over the cells around each vertex, one order more accurate than the resultants of a
// single cell. A polynomial of the elements' degree is fitted by least squares to the values at the resultant points
// of the vertex's cells (superconvergent patch recovery: Zienkiewicz and Zhu, Int. J. Numer. Methods Eng. 33, 1992).
// All values are turned into the vertex's tangent plane. In a cell the polynomials of its vertices are blended, so
// that the result is continuous.
#pragma once
#include <plastron/recovery/patches.hpp>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace plastron::recovery {

/// The degree of the patches' polynomials. A patch is twice as wide as a cell. A polynomial of the elements' degree k
/// is therefore less accurate there than the element, by 2^k times the ratio of successive coefficients. Higher
/// degrees compensate this on coarse meshes.
int patch_degree(const fem::Space& space);

class ResultantPatches {
 public:
  /// Fits polynomials of patch_degree() (collective).
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution)
      : ResultantPatches(discrete, solution, patch_degree(discrete.space())) {}
  /// Fits polynomials of another degree, which the points of a patch must determine.
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution, int degree);
  /// Fits the resultants of a motion on the patches of another field; making patches costs as much as the fit itself.
  ResultantPatches(const assembly::DiscreteShell& discrete, const algebra::Vector& motion,
                   std::shared_ptr<const Patches> patches);

  const std::shared_ptr<const Patches>& patches() const { return patches_; }
  /// Whether a vertex of the owned cell has a patch.
  bool has_patch(std::size_t cell) const { return patches_->best(cell) != Patches::Kind::none; }
  /// Resultants at the point xi of an owned cell in the given axes. `position` and `axes` belong to this point. Empty
  /// if no vertex of the cell has a patch.
  std::optional<Resultants> at(std::size_t cell, const Eigen::Vector2d& xi, const Vector3d& position,
                               const SurfaceAxes& axes) const;

  /// A point of an owned cell and a weight for each resultant there.
  struct Weighed {
    std::size_t cell = 0;
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();
    Vector3d position = Vector3d::Zero();
    SurfaceAxes axes{};
    Resultants weights = Resultants::Zero();
  };
  /// Adds forces f with f . v = weights . at(...) for motions v to the owned cells' nodes (block 6; ghosts need accumulation).
  /// `point` is set on one rank alone, in a cell that has_patch() (collective).
  void add_transposed(const assembly::DiscreteShell& discrete, const std::optional<Weighed>& point,
                      algebra::Vector& f) const;

 private:
  /// The vertices whose polynomials are blended at a point of a cell, with their weights.
  std::vector<std::pair<algebra::LocalIndex, double>> blended(std::size_t cell, const Eigen::Vector2d& xi) const;
  void fit(const std::vector<CellResultants>& cells);

  mesh::Shape shape_;
  std::shared_ptr<const Patches> patches_{};
  algebra::Vector coefficients_{};  ///< terms x 8 per vertex
};

}  // namespace plastron::recovery
