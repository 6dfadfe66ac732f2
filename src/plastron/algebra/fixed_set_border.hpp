// Changes of the fixed set of a factorised system that need no new factor: of the unknowns eliminated last, the tail,
// and by a border of a few others. L L' is the available factor. The unknowns J are released; the columns of E are the
// unit vectors of newly fixed unknowns:
//   [A   A_J   E] [x  ]   [b  ]          W = [A_J  E],  Y = L^{-1} W,  y = L^{-1} b,  t = (x_J, mu),
//   [A_J' A_JJ  ] [x_J] = [b_J],         (D - Y' T Y) t = (b_J, 0) - Y' T y,  L' x = T (y - Y t),  D = A_JJ and zeros,
//   [E'         ] [mu ]   [0  ]
// where T is 1 except on the tail. On the tail T is TailComplement::solve() with the tail's fixed unknowns.
// Includes CHOLMOD: for .cc files only.
#pragma once
#include <suitesparse/cholmod.h>

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

/// The unknowns eliminated last, after all others. The factor's last block L gives their Schur complement S = L L',
/// dense. Fixing some of them changes S only: the others F get the factor of S_FF.
class TailComplement {
 public:
  TailComplement() = default;
  /// Takes L by columns, `size` x `size`, zero above the diagonal.
  TailComplement(std::size_t size, std::vector<double> factor);

  /// Factorises S without the fixed ones. Returns false if a pivot is not positive.
  bool fix(const std::vector<char>& fixed);
  /// Solves in place, for each column of size(). Input is the part of L^{-1} b after the elimination of the others.
  /// Output is L' z with S_FF z_F = b_F and z = 0 where fixed.
  void solve(std::span<double> columns) const;
  std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
  std::vector<double> factor_{};      ///< L
  std::vector<double> complement_{};  ///< S, its lower half
  std::vector<std::size_t> free_{};
  std::vector<double> free_factor_{};  ///< factor of S_FF
};

/// Entries of a vector; all others are zero.
struct SparseVector {
  std::vector<std::size_t> rows{};
  std::vector<double> values{};

  void push_back(std::size_t row, double value) {
    rows.push_back(row);
    values.push_back(value);
  }
};

/// A column of W and of Y. w is the column of a released unknown, or the unit vector of a newly fixed one, and
/// y = L^{-1} w. Besides the unknown's own entry, y has entries only on the path of later eliminations.
struct BorderColumn {
  SparseVector w{};  ///< entries by unknowns, including unknowns that the factor fixes
  SparseVector y{};  ///< entries by places in the order of elimination
};

/// Returns columns of the matrix A + shift diag(A) of one rank.
std::vector<SparseVector> matrix_columns(const MatrixStorage& A, double shift, std::span<const std::size_t> unknowns);

/// Returns L^{-1} w for the factor L by supernodes. `work` must be zero everywhere, and is zero again afterwards.
SparseVector lower_solve(const cholmod_factor& L, const SparseVector& w, std::span<double> work);

/// The columns of released and newly fixed unknowns. A column costs a small part of a solve, and is kept as long as the
/// factor.
class BorderColumns {
 public:
  BorderColumns() = default;
  /// Makes columns for a factor of A + shift diag(A) that fixes unknowns where `fixed_in_factor` is not 0. `place` is
  /// the place of each unknown in the factor. All arguments must outlive this object.
  BorderColumns(const MatrixStorage& A, double shift, const cholmod_factor& L, std::span<const int> place,
                std::span<const double> fixed_in_factor)
      : A_(&A), shift_(shift), L_(&L), place_(place), fixed_in_factor_(fixed_in_factor) {}

  /// Returns the columns of unknowns. For unknowns that the factor fixes, they release them; for others, they fix
  /// them. The columns keep their address as long as this object exists.
  std::vector<const BorderColumn*> of(std::span<const std::size_t> unknowns);
  bool has(std::size_t unknown) const { return made_.contains(unknown); }

 private:
  bool is_fixed(std::size_t i) const { return fixed_in_factor_[i] != 0; }
  void make(std::size_t unknown, SparseVector w);
  SparseVector answer(const SparseVector& w);

  const MatrixStorage* A_ = nullptr;
  double shift_ = 0;
  const cholmod_factor* L_ = nullptr;
  std::span<const int> place_{};
  std::span<const double> fixed_in_factor_{};
  std::unordered_map<std::size_t, BorderColumn> made_{};
  std::vector<double> work_{};
};

class FixedSetBorder {
 public:
  FixedSetBorder() = default;
  /// Makes the border. `let_go` are fixed in the factor, `fixed` are not. `columns` must outlive this object. `tail`
  /// is the end of `size` unknowns.
  FixedSetBorder(std::vector<std::size_t> let_go, std::span<const std::size_t> fixed, BorderColumns& columns,
                 const TailComplement& tail, std::size_t size);
  /// Whether the border has an inverse.
  bool is_regular() const { return is_regular_; }

  std::span<const std::size_t> let_go() const { return let_go_; }
  /// Changes T y to T (y - Y t), by places in the order of elimination, and b_J to x_J.
  void correct(std::span<double> Ty, std::span<double> at_let_go) const;

 private:
  /// A column of Y. `head` of its entries are before the tail.
  struct Column {
    const SparseVector* y;
    std::size_t head;
  };
  void take_columns(std::span<const BorderColumn* const> members, const TailComplement& tail);
  void take_products();
  void take_block(std::span<const BorderColumn* const> members);
  std::span<const double> tail(std::size_t c) const { return std::span(tails_).subspan(c * tail_size_, tail_size_); }

  std::vector<std::size_t> let_go_{};
  std::vector<Column> columns_{};
  std::size_t tail_begin_ = 0, tail_size_ = 0;
  std::vector<double> tails_{};   ///< T Y on the tail, by columns
  std::vector<double> border_{};  ///< D - Y' T Y, factorised
  std::vector<int> pivots_{};
  bool is_regular_ = true;
};

}  // namespace plastron::algebra
