// The cells around each vertex as patches on which polynomials are fitted, the same for all fields on a mesh.
//
// There is no patch across what may jump: a vertex on a named curve, between regions or on a kink has none, nor one of a single cell.
// Where points lie in too few rows for a polynomial (one row of cells has as many rows of points as their degree) or cells of very
// different sizes meet, a patch takes the highest degrees along and across that its points determine. A vertex on an edge of the shell
// has the last choice, a narrow patch; cells go by the best of their vertices' patches.
#pragma once
#include <plastron/recovery/resultants.hpp>
#include <plastron/recovery/vertices.hpp>

#include <Eigen/Core>

#include <span>
#include <vector>

namespace plastron::recovery {

class Patches {
 public:
  static constexpr int most_degree = 12;  ///< of a polynomial: elements have up to 8
  /// Values of its terms, kept where they are made: there are millions of them in an estimate.
  using Terms = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, (most_degree + 1) * (most_degree + 2) / 2>;
  /// Ascending: `lower` ones have the elements' degree at least in both directions.
  enum class Kind { none, narrow, lower, full };
  /// Where the polynomial of a vertex lives: its tangent plane, with the square that the patch is in two oblique coordinates.
  struct Plane {
    Kind most = Kind::none;                ///< the best patch that the vertex may have
    Vector3d position = Vector3d::Zero();  ///< the middle of the patch's points, in the tangent plane [m]
    SurfaceAxes axes;                      ///< t1 and t2 in the tangent plane
    Eigen::Matrix2d to_square;             ///< from lengths along them: (-1, 1)^2 is the patch [1/m]
  };

  /// Of polynomials of this degree, `most_degree` at most (std::invalid_argument), fitted at the points of owned `cells`, whose values do not count (collective).
  Patches(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells, int degree);

  Patches(const Patches&) = delete;
  Patches& operator=(const Patches&) = delete;

  const Vertices& vertices() const { return vertices_; }
  algebra::LocalIndex vertex(std::size_t cell, int corner) const { return vertices_.at(space_, cell, corner); }
  const Plane& plane(algebra::LocalIndex vertex) const { return planes_[static_cast<std::size_t>(vertex)]; }
  Kind kind(algebra::LocalIndex vertex) const;
  /// Of the vertices of an owned cell.
  Kind best(std::size_t cell) const;

  Eigen::Index terms() const { return terms_; }  ///< of a polynomial
  /// The polynomials' basis: products of Chebyshev polynomials of a total degree up to that given.
  Terms basis(const Plane& plane, const Vector3d& position) const;
  /// Whether a point with these axes is near enough to the plane to belong to its patch.
  bool reaches(const Plane& plane, const SurfaceAxes& axes) const;
  /// Calls take(vertex, its plane, cell, number of the point) for each point of each cell round each vertex that may have a patch.
  template <class Take>
  void for_points(const std::vector<CellResultants>& cells, const Take& take) const {
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      for (int k = 0; k < corners_; ++k) {
        const algebra::LocalIndex at = vertex(cell, k);
        if (plane(at).most == Kind::none) continue;
        for (std::size_t p = 0; p < cells[cell].position.size(); ++p) take(at, plane(at), cells[cell], p);
      }
  }
  /// Coefficients of an owned vertex, a column for each of the right-hand sides sum basis' value; zero without a patch.
  Eigen::MatrixXd solve(algebra::LocalIndex vertex, const Eigen::MatrixXd& right) const;

 private:
  /// Terms that make a patch of this kind, if its points determine them.
  struct Candidate {
    Kind kind;
    std::vector<Eigen::Index> terms;
  };
  /// Of the normal equations of a vertex; without terms there is no patch.
  struct Solver {
    const std::vector<Eigen::Index>* terms = nullptr;
    Eigen::MatrixXd inverse{};
  };

  void corner_jets(const assembly::DiscreteShell& discrete, std::size_t cell,
                   std::vector<geometry::SurfaceJet>& jets) const;
  algebra::Vector sums_round_vertices(const assembly::DiscreteShell& discrete,
                                      const std::vector<CellResultants>& cells) const;
  algebra::Vector place(const assembly::DiscreteShell& discrete, const algebra::Vector& sums);
  void find_planes(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells);
  /// From sums over its cells; their edges have this angle where the patch is square.
  void set_plane(algebra::LocalIndex vertex, std::span<const double> sum, double angle);
  algebra::Vector normal_matrices(const std::vector<CellResultants>& cells) const;
  /// Up to one degree in the first coordinate of the square and another in the second: places in the basis.
  std::vector<Eigen::Index> terms_up_to(int first, int second) const;
  std::vector<Candidate> candidates() const;
  void decompose(const algebra::Vector& normal_matrices);

  const fem::Space& space_;
  int corners_;
  int degree_;
  Eigen::Index terms_;
  Vertices vertices_;
  std::vector<Candidate> candidates_;  ///< the best first
  std::vector<Plane> planes_{};
  algebra::Vector kinds_{};
  std::vector<Solver> solvers_{};  ///< of owned vertices
};

}  // namespace plastron::recovery
