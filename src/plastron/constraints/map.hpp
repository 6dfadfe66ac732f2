// Constraints between nodes: linear equations that give the values v of all nodes from unknown values w,
//   v = C w,     v_node = sum over the terms of its row: weight block w_term.
// A node with a row is constrained. Other nodes are free, v_node = w_node. A constrained node may occur in its own row:
// then a part of its values is its own. It may also store unknowns for others, which occur in their rows. Forces are
// transformed by the transposed map C'.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/vector.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace plastron::constraints {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Term {
  algebra::LocalIndex node = 0;
  double weight = 1;
  /// For six values of a node. Null is the identity, for any number of values.
  std::shared_ptr<const Matrix6> block{};
};
/// Returns a term with a block.
Term term(algebra::LocalIndex node, const Matrix6& block);

/// The equation of one constrained node.
struct Row {
  algebra::LocalIndex node = 0;
  std::vector<Term> terms{};

  /// Returns the matrix of the node's own six values; zero if it keeps none.
  Matrix6 own() const;
};

/// A matrix with the same number of columns for each of its nodes.
struct NodeColumns {
  std::vector<algebra::LocalIndex> nodes{};
  RowMatrix matrix{};
};

class Map {
 public:
  Map() = default;  ///< the identity
  /// `rows` has the rows of all local nodes. Nodes of terms are local too (collective).
  Map(std::vector<Row> rows, MPI_Comm comm);

  const std::vector<Row>& rows() const { return rows_; }  ///< by ascending node
  const Row* find(std::size_t node) const;                ///< null if the node is free
  bool constrains(std::size_t node) const { return find(node) != nullptr; }
  bool is_identity() const { return is_identity_; }  ///< true if no rank has a row

  /// Computes v = C w in place. Needs current ghosts, leaves them current.
  void apply(algebra::Vector& v) const;
  /// Computes f := C' f on owned nodes. f is complete on owned nodes before and after (collective).
  void apply_transposed(algebra::Vector& f) const;

  /// Returns the nodes whose w determine the values v of `nodes`.
  std::vector<algebra::LocalIndex> sources(std::span<const algebra::LocalIndex> nodes) const;
  /// Returns the sources of each element, for the pattern of a matrix.
  algebra::Connectivity couplings(const algebra::Connectivity& elements) const;
  /// Transforms a matrix on the values v of `nodes`: the result applies to w of their sources.
  NodeColumns on_sources(std::span<const algebra::LocalIndex> nodes, RowMatrix matrix) const;

  /// Changes local numbers after the layout has got more ghosts.
  void renumber(const algebra::Distribution& before, const algebra::Distribution& after);

 private:
  std::vector<Row> rows_{};
  std::vector<char> is_read_{};  ///< 1 for a row whose node occurs in the terms of another row
  bool is_identity_ = true;
};

/// Returns the map v = outer inner w: rows of rows are resolved once (collective).
Map compose(const Map& outer, const Map& inner, MPI_Comm comm);

}  // namespace plastron::constraints
