#include <petscsys.h>
// must follow petscsys.h, without which it does not compile
#include <petscblaslapack.h>

#include <algorithm>
#include <utility>

#include "fixed_set_border.hpp"

namespace plastron::algebra {
namespace {

// Arguments of the BLAS.
constexpr char blas_left = 'L', blas_lower = 'L', blas_plain = 'N', blas_transposed = 'T', blas_not_unit = 'N';

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
    const auto n = static_cast<PetscBLASInt>(columns), length = static_cast<PetscBLASInt>(rows.size());
    const PetscBLASInt below = length - n, one = 1;
    const double unit = 1, zero = 0;
    double* own = x.data() + first;
    BLAStrsm_(&blas_left, &blas_lower, &blas_plain, &blas_not_unit, &n, &one, &unit, values, &length, own, &n);
    if (below == 0) return;
    space.resize(static_cast<std::size_t>(below));
    BLASgemv_(&blas_plain, &below, &n, &unit, values + n, &length, own, &one, &zero, space.data(), &one);
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

double dot(const SparseVector& a, std::span<const double> x) {
  double sum = 0;
  for (std::size_t e = 0; e < a.rows.size(); ++e) sum += a.values[e] * x[a.rows[e]];
  return sum;
}

}  // namespace

TailComplement::TailComplement(std::size_t size, std::vector<double> factor)
    : size_(size), factor_(std::move(factor)), complement_(size * size) {
  if (size_ == 0) return;
  const double unit = 1, zero = 0;
  const auto n = static_cast<PetscBLASInt>(size_);
  BLASsyrk_(&blas_lower, &blas_plain, &n, &n, &unit, factor_.data(), &n, &zero, complement_.data(), &n);
}

bool TailComplement::fix(const std::vector<char>& fixed) {
  free_.clear();
  for (std::size_t i = 0; i < size_; ++i)
    if (!fixed[i]) free_.push_back(i);
  const std::size_t n = free_.size();
  free_factor_.resize(n * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) free_factor_[j * n + i] = complement_[free_[j] * size_ + free_[i]];
  if (n == 0) return true;
  const auto order = static_cast<PetscBLASInt>(n);
  PetscBLASInt outcome = 0;
  LAPACKpotrf_(&blas_lower, &order, free_factor_.data(), &order, &outcome);
  return outcome == 0;
}

void TailComplement::solve(std::span<double> columns) const {
  if (columns.empty()) return;
  const std::size_t count = columns.size() / size_;
  const auto n = static_cast<PetscBLASInt>(size_), m = static_cast<PetscBLASInt>(free_.size()),
             k = static_cast<PetscBLASInt>(count);
  const double unit = 1, zero = 0;
  std::vector<double> product(columns.size()), z;
  BLASgemm_(&blas_plain, &blas_plain, &n, &k, &n, &unit, factor_.data(), &n, columns.data(), &n, &zero, product.data(),
            &n);
  z.reserve(free_.size() * count);
  for (std::size_t c = 0; c < count; ++c)
    for (const std::size_t i : free_) z.push_back(product[c * size_ + i]);
  PetscBLASInt outcome = 0;
  if (m > 0) LAPACKpotrs_(&blas_lower, &m, &k, free_factor_.data(), &m, z.data(), &m, &outcome);
  std::ranges::fill(product, 0.0);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < free_.size(); ++i) product[c * size_ + free_[i]] = z[c * free_.size() + i];
  BLASgemm_(&blas_transposed, &blas_plain, &n, &k, &n, &unit, factor_.data(), &n, product.data(), &n, &zero,
            columns.data(), &n);
}

std::vector<SparseVector> matrix_columns(const MatrixStorage& A, double shift, std::span<const std::size_t> unknowns) {
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
    if (!made_.contains(i) && is_fixed(i)) let_go.push_back(i);
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

/// Omits the unknowns that the factor has fixed.
SparseVector BorderColumns::answer(const SparseVector& w) {
  work_.resize(L_->n, 0.0);
  SparseVector placed;
  for (std::size_t e = 0; e < w.rows.size(); ++e)
    if (!is_fixed(w.rows[e])) placed.push_back(static_cast<std::size_t>(place_[w.rows[e]]), w.values[e]);
  return lower_solve(*L_, placed, work_);
}

FixedSetBorder::FixedSetBorder(std::vector<std::size_t> let_go, std::span<const std::size_t> fixed,
                               BorderColumns& columns, const TailComplement& tail, std::size_t size)
    : let_go_(std::move(let_go)), tail_begin_(size - tail.size()), tail_size_(tail.size()) {
  std::vector<std::size_t> all = let_go_;
  all.insert(all.end(), fixed.begin(), fixed.end());
  if (all.empty()) return;
  const std::vector<const BorderColumn*> members = columns.of(all);
  take_columns(members, tail);
  take_products();
  take_block(members);
  const auto order = static_cast<PetscBLASInt>(all.size());
  PetscBLASInt outcome = 0;
  pivots_.assign(all.size(), 0);
  LAPACKgetrf_(&order, &order, border_.data(), &order, pivots_.data(), &outcome);
  is_regular_ = outcome == 0;
}

void FixedSetBorder::take_columns(std::span<const BorderColumn* const> members, const TailComplement& tail) {
  tails_.assign(members.size() * tail_size_, 0.0);
  for (std::size_t c = 0; c < members.size(); ++c) {
    const SparseVector& y = members[c]->y;
    const auto begin = std::ranges::lower_bound(y.rows, tail_begin_);
    columns_.push_back({.y = &y, .head = static_cast<std::size_t>(begin - y.rows.begin())});
    for (std::size_t e = columns_.back().head; e < y.rows.size(); ++e)
      tails_[c * tail_size_ + y.rows[e] - tail_begin_] = y.values[e];
  }
  tail.solve(tails_);
}

/// Computes - Y' T Y, both halves.
void FixedSetBorder::take_products() {
  const std::size_t k = columns_.size();
  border_.assign(k * k, 0.0);
  std::vector<double> Ty(tail_begin_ + tail_size_, 0.0);
  for (std::size_t c = 0; c < k; ++c) {
    const Column& column = columns_[c];
    for (std::size_t e = 0; e < column.head; ++e) Ty[column.y->rows[e]] = column.y->values[e];
    std::ranges::copy(tail(c), Ty.begin() + static_cast<std::ptrdiff_t>(tail_begin_));
    for (std::size_t r = 0; r <= c; ++r) border_[c * k + r] = border_[r * k + c] = -dot(*columns_[r].y, Ty);
    for (std::size_t e = 0; e < column.head; ++e) Ty[column.y->rows[e]] = 0;
  }
}

/// Adds A_JJ.
void FixedSetBorder::take_block(std::span<const BorderColumn* const> members) {
  std::unordered_map<std::size_t, std::size_t> number;
  for (std::size_t r = 0; r < let_go_.size(); ++r) number.emplace(let_go_[r], r);
  for (std::size_t c = 0; c < let_go_.size(); ++c) {
    const SparseVector& w = members[c]->w;
    for (std::size_t e = 0; e < w.rows.size(); ++e)
      if (const auto r = number.find(w.rows[e]); r != number.end())
        border_[c * members.size() + r->second] += w.values[e];
  }
}

void FixedSetBorder::correct(std::span<double> Ty, std::span<double> at_let_go) const {
  if (columns_.empty()) return;
  std::vector<double> t;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    t.push_back((c < at_let_go.size() ? at_let_go[c] : 0) - dot(*columns_[c].y, Ty));
  const auto order = static_cast<PetscBLASInt>(t.size());
  const PetscBLASInt one = 1;
  PetscBLASInt outcome = 0;
  LAPACKgetrs_(&blas_plain, &order, &one, border_.data(), &order, pivots_.data(), t.data(), &order, &outcome);
  for (std::size_t c = 0; c < t.size(); ++c) {
    const Column& column = columns_[c];
    for (std::size_t e = 0; e < column.head; ++e) Ty[column.y->rows[e]] -= column.y->values[e] * t[c];
    for (std::size_t e = 0; e < tail_size_; ++e) Ty[tail_begin_ + e] -= tail(c)[e] * t[c];
  }
  std::copy_n(t.begin(), at_let_go.size(), at_let_go.begin());
}

}  // namespace plastron::algebra
