// Columns of unknowns with changed pins in a border of a factorised system (pin_border.hpp). w is the column of a
// released unknown, or the unit vector of a newly pinned one, and y = L^{-1} w. Besides the unknown's own entry, y has
// entries only on the path of later eliminations. It costs a small part of a solve, and is kept as long as the factor.
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
  SparseVector w{};  ///< entries by unknowns, including unknowns that the factor has pinned
  SparseVector y{};  ///< entries by places in the order of elimination
};

/// Returns columns of the matrix A + shift diag(A) of one rank.
std::vector<SparseVector> matrix_columns(const Matrix::Storage& A, double shift, std::span<const std::size_t> unknowns);

/// Returns L^{-1} w for the factor L by supernodes. `work` must be zero everywhere, and is zero again afterwards.
SparseVector lower_solve(const cholmod_factor& L, const SparseVector& w, std::span<double> work);

class BorderColumns {
 public:
  BorderColumns() = default;
  /// Makes columns for a factor of A + shift diag(A) with pins where `factor_pins` is not 0. `place` is the place of
  /// each unknown in the factor. All arguments must outlive this object.
  BorderColumns(const Matrix::Storage& A, double shift, const cholmod_factor& L, std::span<const int> place,
                std::span<const double> factor_pins)
      : A_(&A), shift_(shift), L_(&L), place_(place), factor_pins_(factor_pins) {}

  /// Returns the columns of unknowns. For unknowns that the factor has pinned, they release them; for others, they pin
  /// them. The columns keep their address as long as this object exists.
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
