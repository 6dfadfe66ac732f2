// Patches of the cells around each vertex for fitting polynomials, the same for all fields on a mesh. The vertices are
// nodes of a separate layout.
//
// A patch never crosses a possible jump: a vertex on a named curve, between regions or on a kink has none. A patch
// has at least two cells. In some patches the points lie in too few rows for a polynomial: one row of cells of degree
// k has only k rows of points. In others, cells of very different sizes meet. Such a patch takes the highest degrees
// along and across that its points determine. A vertex on an edge of the shell has only the last choice, a narrow
// patch. A cell has the kind of the best patch of its vertices.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/space.hpp>
#include <plastron/recovery/resultants.hpp>

#include <Eigen/Core>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace plastron::recovery {

/// Corners of cells on this rank, in the order of the nodes.
class Vertices {
 public:
  /// Numbers the vertices (collective).
  explicit Vertices(const fem::Space& space);

  const std::shared_ptr<const algebra::Layout>& layout() const { return layout_; }
  /// Index in the layout of the vertex at a corner of a cell; -1 at ghost cells whose vertex this rank does not have.
  algebra::LocalIndex at(const fem::Space& space, std::size_t cell, int corner) const {
    return vertex_of_node_[static_cast<std::size_t>(space.nodes(cell)[corner_node(corner)])];
  }

 private:
  std::size_t corner_node(int corner) const { return corner_nodes_[static_cast<std::size_t>(corner)]; }

  std::array<std::size_t, 4> corner_nodes_{};  // places of a cell's corners among its nodes
  std::vector<algebra::LocalIndex> vertex_of_node_;
  std::shared_ptr<const algebra::Layout> layout_;
};

class Patches {
 public:
  static constexpr int most_degree = 12;  ///< largest degree of a polynomial: elements have up to 8
  /// Values of a polynomial's terms, without dynamic memory: an estimate makes millions of them.
  using Terms = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, (most_degree + 1) * (most_degree + 2) / 2>;
  /// Kinds in ascending order. A `lower` patch has at least the elements' degree in both directions.
  enum class Kind { none, narrow, lower, full };
  /// Domain of a vertex's polynomial: its tangent plane, with two oblique coordinates in which the patch is a square.
  struct Plane {
    Kind most = Kind::none;                ///< best patch that the vertex may have
    Vector3d position = Vector3d::Zero();  ///< middle of the patch's points, in the tangent plane [m]
    SurfaceAxes axes;                      ///< t1 and t2 in the tangent plane
    Eigen::Matrix2d to_square;             ///< maps lengths along t1 and t2 to the patch's square (-1, 1)^2 [1/m]
  };

  /// Makes patches for polynomials of a degree of at most `most_degree`; throws std::invalid_argument otherwise. They
  /// are fitted at the points of the owned `cells`, whose values are ignored (collective).
  Patches(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells, int degree);

  Patches(const Patches&) = delete;
  Patches& operator=(const Patches&) = delete;

  const Vertices& vertices() const { return vertices_; }
  algebra::LocalIndex vertex(std::size_t cell, int corner) const { return vertices_.at(space_, cell, corner); }
  const Plane& plane(algebra::LocalIndex vertex) const { return planes_[static_cast<std::size_t>(vertex)]; }
  Kind kind(algebra::LocalIndex vertex) const;
  /// The best kind among the vertices of an owned cell.
  Kind best(std::size_t cell) const;

  Eigen::Index terms() const { return terms_; }  ///< number of terms of a polynomial
  /// The polynomials' basis: products of Chebyshev polynomials up to the given total degree.
  Terms basis(const Plane& plane, const Vector3d& position) const;
  /// Whether a point with these axes is near enough to the plane to belong to its patch.
  bool reaches(const Plane& plane, const SurfaceAxes& axes) const;
  /// Calls take(vertex, its plane, cell, number of the point) for each point of each cell at each vertex that may
  /// have a patch.
  template <class Take>
  void for_points(const std::vector<CellResultants>& cells, const Take& take) const {
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      for (int k = 0; k < corners_; ++k) {
        const algebra::LocalIndex at = vertex(cell, k);
        if (plane(at).most == Kind::none) continue;
        for (std::size_t p = 0; p < cells[cell].position.size(); ++p) take(at, plane(at), cells[cell], p);
      }
  }
  /// Coefficients of an owned vertex, a column per right-hand side sum basis' value; zero without a patch.
  Eigen::MatrixXd solve(algebra::LocalIndex vertex, const Eigen::MatrixXd& right) const;

 private:
  /// Terms of a patch of this kind, used if its points determine them.
  struct Candidate {
    Kind kind;
    std::vector<Eigen::Index> terms;
  };
  /// Solver of a vertex's normal equations; without terms there is no patch.
  struct Solver {
    const std::vector<Eigen::Index>* terms = nullptr;
    Eigen::MatrixXd inverse{};
  };

  void corner_frames(const assembly::DiscreteShell& discrete, std::size_t cell,
                     std::vector<geometry::Frame>& frames) const;
  algebra::Vector sums_round_vertices(const assembly::DiscreteShell& discrete,
                                      const std::vector<CellResultants>& cells) const;
  algebra::Vector place(const assembly::DiscreteShell& discrete, const algebra::Vector& sums);
  void find_planes(const assembly::DiscreteShell& discrete, const std::vector<CellResultants>& cells);
  /// Sets the plane from sums over the vertex's cells. `angle` is the angle of their edges in the square patch.
  void set_plane(algebra::LocalIndex vertex, std::span<const double> sum, double angle);
  algebra::Vector normal_matrices(const std::vector<CellResultants>& cells) const;
  /// Places in the basis of terms up to one degree in the square's first coordinate and another in the second.
  std::vector<Eigen::Index> terms_up_to(int first, int second) const;
  std::vector<Candidate> candidates() const;
  void decompose(const algebra::Vector& normal_matrices);

  const fem::Space& space_;
  int corners_;
  int degree_;
  Eigen::Index terms_;
  Vertices vertices_;
  std::vector<Candidate> candidates_;  ///< best first
  std::vector<Plane> planes_{};
  algebra::Vector kinds_{};
  std::vector<Solver> solvers_{};  ///< solvers of owned vertices
};

}  // namespace plastron::recovery
