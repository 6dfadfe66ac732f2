// What unknowns whose pins change bring into a border of a factorised system (pin_border.hpp): the column w of an unknown that is let go, or
// the unit vector of one that is pinned, and y = L^{-1} w. Beside that of the unknown itself, y has entries only where eliminations that follow
// from it lead, so that it costs a small part of a solve; it is kept as long as the factor is.
// Includes CHOLMOD: for .cc files only.
#pragma once
#include <suitesparse/cholmod.h>

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

/// Entries of a vector; all others are zero.
struct SparseVector {
  std::vector<std::size_t> rows{};
  std::vector<double> values{};

  void push_back(std::size_t row, double value) {
    rows.push_back(row);
    values.push_back(value);
  }
};

struct BorderColumn {
  SparseVector w{};  ///< by unknowns: with those that the factor has pinned
  SparseVector y{};  ///< by places in the order of elimination
};

/// Columns of A + shift diag(A), of one rank.
std::vector<SparseVector> matrix_columns(const Matrix::Storage& A, double shift, std::span<const std::size_t> unknowns);

/// L^{-1} w for the factor L by supernodes. `work` is zero in each of its places, and is left so.
SparseVector lower_solve(const cholmod_factor& L, const SparseVector& w, std::span<double> work);

class BorderColumns {
 public:
  BorderColumns() = default;
  /// Of a factor of A + shift diag(A) with pins where `factor_pins` is not 0; `place` of each unknown in it. All must outlive this object.
  BorderColumns(const Matrix::Storage& A, double shift, const cholmod_factor& L, std::span<const int> place,
                std::span<const double> factor_pins)
      : A_(&A), shift_(shift), L_(&L), place_(place), factor_pins_(factor_pins) {}

  /// Of unknowns which the factor has pinned: to let them go. Of others: to pin them. They stay where they are as long as this object.
  std::vector<const BorderColumn*> of(std::span<const std::size_t> unknowns);
  bool has(std::size_t unknown) const { return made_.contains(unknown); }

 private:
  bool is_pinned(std::size_t i) const { return factor_pins_[i] != 0; }
  void make(std::size_t unknown, SparseVector w);
  SparseVector answer(const SparseVector& w);

  const Matrix::Storage* A_ = nullptr;
  double shift_ = 0;
  const cholmod_factor* L_ = nullptr;
  std::span<const int> place_{};
  std::span<const double> factor_pins_{};
  std::unordered_map<std::size_t, BorderColumn> made_{};
  std::vector<double> work_{};
};

}  // namespace plastron::algebra
