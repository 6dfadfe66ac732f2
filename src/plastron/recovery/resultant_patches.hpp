// Stress resultants smoothed over the cells around each vertex, an order more accurate than those of a cell alone: a polynomial of the
// elements' degree is fitted by least squares to the values at the resultant points of the vertex's cells (superconvergent patch
// recovery: Zienkiewicz and Zhu, Int. J. Numer. Methods Eng. 33, 1992), each turned into the vertex's tangent plane. In a cell the
// polynomials of its vertices are blended, so that the result is continuous.
#pragma once
#include <plastron/recovery/patches.hpp>

#include <memory>
#include <optional>

namespace plastron::recovery {

class ResultantPatches {
 public:
  /// Polynomials of the elements' degree (collective).
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution)
      : ResultantPatches(discrete, solution, discrete.space().degree) {}
  /// Polynomials of another degree, of which the points of a patch have to know enough.
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution, int degree);
  /// On the patches of another field, which cost as much as the fit itself.
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                   std::shared_ptr<const Patches> patches);

  const std::shared_ptr<const Patches>& patches() const { return patches_; }
  /// Whether a vertex of the owned cell has a patch.
  bool has_patch(std::size_t cell) const { return patches_->best(cell) != Patches::Kind::none; }
  /// At the point xi of an owned cell, whose position and axes are given, in these axes; empty if no vertex of the cell has a patch.
  std::optional<Resultants> at(std::size_t cell, const Eigen::Vector2d& xi, const Vector3d& position,
                               const SurfaceAxes& axes) const;

 private:
  void fit(const std::vector<CellResultants>& cells);

  fem::Shape shape_;
  std::shared_ptr<const Patches> patches_{};
  algebra::Vector coefficients_{};  ///< terms x 8 by vertex
};

}  // namespace plastron::recovery
