#include "border_columns.hpp"

#include <petscsys.h>
// must follow petscsys.h, without which it does not compile
#include <petscblaslapack.h>

#include <algorithm>

namespace plastron::algebra {
namespace {

/// A supernode of a factor: columns that share their pattern, stored as a dense block with the rows below.
struct Supernode {
  Supernode(const cholmod_factor& L, std::size_t k)
      : first(static_cast<const int*>(L.super)[k]),
        columns(static_cast<const int*>(L.super)[k + 1] - first),
        rows(static_cast<const int*>(L.s) + static_cast<const int*>(L.pi)[k],
             static_cast<const int*>(L.s) + static_cast<const int*>(L.pi)[k + 1]),
        values(static_cast<const double*>(L.x) + static_cast<const int*>(L.px)[k]) {}

  /// Solves in place (x by places): the entries of the columns, and their contributions to the rows below.
  void solve(std::span<double> x, std::vector<double>& space) const {
    const char side = 'L', lower = 'L', plain = 'N', not_unit = 'N';
    const auto n = static_cast<PetscBLASInt>(columns), length = static_cast<PetscBLASInt>(rows.size());
    const PetscBLASInt below = length - n, one = 1;
    const double unit = 1, zero = 0;
    double* own = x.data() + first;
    BLAStrsm_(&side, &lower, &plain, &not_unit, &n, &one, &unit, values, &length, own, &n);
    if (below == 0) return;
    space.resize(static_cast<std::size_t>(below));
    BLASgemv_(&plain, &below, &n, &unit, values + n, &length, own, &one, &zero, space.data(), &one);
    for (std::size_t r = 0; r < space.size(); ++r)
      x[static_cast<std::size_t>(rows[static_cast<std::size_t>(columns) + r])] -= space[r];
  }

  int first, columns;
  std::span<const int> rows;
  const double* values;
};

/// Returns the supernode of a column.
std::size_t supernode_of(const cholmod_factor& L, int column) {
  const std::span super(static_cast<const int*>(L.super), L.nsuper + 1);
  return static_cast<std::size_t>(std::ranges::upper_bound(super, column) - super.begin()) - 1;
}

}  // namespace

std::vector<SparseVector> matrix_columns(const Matrix::Storage& A, double shift,
                                         std::span<const std::size_t> unknowns) {
  const auto m = static_cast<std::size_t>(A.block);
  std::vector<SparseVector> columns(unknowns.size());
  std::unordered_multimap<std::size_t, std::size_t> of_node;
  std::vector<char> is_wanted(A.global.size(), 0);
  for (std::size_t c = 0; c < unknowns.size(); ++c) {
    of_node.emplace(unknowns[c] / m, c);
    is_wanted[unknowns[c] / m] = 1;
  }
  // Only the upper half is stored. A search through all rows finds a column's part above the diagonal.
  for (LocalIndex node = 0; !unknowns.empty() && node < A.layout->owned; ++node)
    for (std::size_t k = A.row_begin(node); k < A.row_end(node); ++k) {
      const auto row = static_cast<std::size_t>(node), column = static_cast<std::size_t>(A.column[k]);
      if (!is_wanted[row] && !is_wanted[column]) continue;
      const double* B = A.block_at(k);
      for (auto [it, end] = of_node.equal_range(row); it != end; ++it)
        for (std::size_t b = 0; b < m; ++b) {
          const std::size_t a = unknowns[it->second] % m;  // in a diagonal block only the upper half is valid
          const double value = row == column && b < a ? B[b * m + a] : B[a * m + b];
          columns[it->second].push_back(column * m + b, row == column && a == b ? (1 + shift) * value : value);
        }
      for (auto [it, end] = of_node.equal_range(column); row != column && it != end; ++it)
        for (std::size_t a = 0; a < m; ++a)
          columns[it->second].push_back(row * m + a, B[a * m + unknowns[it->second] % m]);
    }
  return columns;
}

SparseVector lower_solve(const cholmod_factor& L, const SparseVector& w, std::span<double> work) {
  std::vector<char> is_reached(L.nsuper, 0);
  std::size_t k = L.nsuper;
  for (std::size_t e = 0; e < w.rows.size(); ++e) {
    work[w.rows[e]] = w.values[e];
    const std::size_t own = supernode_of(L, static_cast<int>(w.rows[e]));
    is_reached[own] = 1;
    k = std::min(k, own);
  }
  SparseVector y;
  std::vector<double> space;
  for (; k < L.nsuper; ++k) {
    if (!is_reached[k]) continue;
    const Supernode node(L, k);
    node.solve(work, space);
    const auto columns = static_cast<std::size_t>(node.columns), first = static_cast<std::size_t>(node.first);
    for (std::size_t column = first; column < first + columns; ++column) {
      y.push_back(column, work[column]);
      work[column] = 0;
    }
    if (columns < node.rows.size()) is_reached[supernode_of(L, node.rows[columns])] = 1;  // its parent in the tree
  }
  return y;
}

std::vector<const BorderColumn*> BorderColumns::of(std::span<const std::size_t> unknowns) {
  std::vector<std::size_t> let_go;
  for (const std::size_t i : unknowns)
    if (!made_.contains(i) && is_pinned(i)) let_go.push_back(i);
  std::vector<SparseVector> w = matrix_columns(*A_, shift_, let_go);
  for (std::size_t c = 0; c < let_go.size(); ++c) make(let_go[c], std::move(w[c]));
  std::vector<const BorderColumn*> columns;
  for (const std::size_t i : unknowns) {
    if (!made_.contains(i)) make(i, {{i}, {1.0}});
    columns.push_back(&made_.at(i));
  }
  return columns;
}

void BorderColumns::make(std::size_t unknown, SparseVector w) {
  SparseVector y = answer(w);
  made_.emplace(unknown, BorderColumn{std::move(w), std::move(y)});
}

/// Omits the unknowns that the factor has pinned.
SparseVector BorderColumns::answer(const SparseVector& w) {
  work_.resize(L_->n, 0.0);
  SparseVector placed;
  for (std::size_t e = 0; e < w.rows.size(); ++e)
    if (!is_pinned(w.rows[e])) placed.push_back(static_cast<std::size_t>(place_[w.rows[e]]), w.values[e]);
  return lower_solve(*L_, placed, work_);
}

}  // namespace plastron::algebra
