// Stress resultants smoothed over the cells around each vertex, an order more accurate than those of a cell alone: a polynomial of the
// elements' degree is fitted by least squares to the values at the resultant points of the vertex's cells (superconvergent patch
// recovery: Zienkiewicz and Zhu, Int. J. Numer. Methods Eng. 33, 1992), each turned into the vertex's tangent plane. In a cell the
// polynomials of its vertices are blended, so that the result is continuous.
//
// There is no patch across what may jump: a vertex on a named curve, between regions or on a kink has none, nor one of a single cell.
// Where points lie in too few rows for a polynomial (one row of cells has as many rows of points as their degree) or cells of very
// different sizes meet, a patch takes the highest degrees along and across that its points determine. A vertex on an edge of the shell
// has the last choice, a narrow patch; cells go by the best of their vertices' patches.
#pragma once
#include <plastron/recovery/resultants.hpp>
#include <plastron/recovery/vertices.hpp>

#include <span>

namespace plastron::recovery {

class ResultantPatches {
 public:
  /// Polynomials of the elements' degree (collective).
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution)
      : ResultantPatches(discrete, solution, discrete.space().degree) {}
  /// Polynomials of another degree, of which the points of a patch have to know enough.
  ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution, int degree);

  /// Whether a vertex of the owned cell has a patch.
  bool has_patch(std::size_t cell) const { return best(cell) != Kind::none; }
  /// At the point xi of an owned cell, whose position and axes are given, in these axes; empty if no vertex of the cell has a patch.
  std::optional<Resultants> at(std::size_t cell, const Eigen::Vector2d& xi, const Vector3d& position,
                               const SurfaceAxes& axes) const;

 private:
  /// Ascending: `lower` ones have the elements' degree at least in both directions.
  enum class Kind { none, narrow, lower, full };
  /// Where the polynomial of a vertex lives: its tangent plane, with the square that the patch is in two oblique coordinates.
  struct Plane {
    Kind most = Kind::none;                ///< the best patch that the vertex may have
    Vector3d position = Vector3d::Zero();  ///< the middle of the patch's points, in the tangent plane [m]
    SurfaceAxes axes;                      ///< t1 and t2 in the tangent plane
    Eigen::Matrix2d to_square;             ///< from lengths along them: (-1, 1)^2 is the patch [1/m]
  };

  void find_planes(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells);
  void fit(const std::vector<CellResultants>& cells);
  /// From sums over its cells; their edges have this angle where the patch is square.
  void set_plane(algebra::LocalIndex vertex, std::span<const double> sum, double angle);
  /// The polynomials' basis: products of Chebyshev polynomials of a total degree up to that of the elements.
  Eigen::RowVectorXd basis(const Plane& plane, const Vector3d& position) const;
  void solve_normal_equations(const algebra::Vector& equations);
  /// Up to one degree in the first coordinate of the square and another in the second: places in the basis.
  std::vector<Eigen::Index> terms_up_to(int first, int second) const;
  Kind kind(algebra::LocalIndex vertex) const;
  /// Of the vertices of an owned cell.
  Kind best(std::size_t cell) const;

  const fem::Space& space_;
  int corners_;
  int degree_;
  Eigen::Index terms_;  ///< of a polynomial
  Vertices vertices_;
  std::vector<Plane> planes_{};
  algebra::Vector coefficients_{};  ///< terms x 8 by vertex, then the patch's kind
};

}  // namespace plastron::recovery
