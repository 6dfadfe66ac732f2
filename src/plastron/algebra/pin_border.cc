#include "pin_border.hpp"

#include <petscsys.h>
// must follow petscsys.h, without which it does not compile
#include <petscblaslapack.h>

#include <algorithm>
#include <utility>

namespace plastron::algebra {
namespace {

double dot(const SparseVector& a, std::span<const double> x) {
  double sum = 0;
  for (std::size_t e = 0; e < a.rows.size(); ++e) sum += a.values[e] * x[a.rows[e]];
  return sum;
}

}  // namespace

PinBorder::PinBorder(std::vector<std::size_t> let_go, std::span<const std::size_t> pinned, BorderColumns& columns,
                     const TailComplement& tail, std::size_t size)
    : let_go_(std::move(let_go)), tail_begin_(size - tail.size()), tail_size_(tail.size()) {
  std::vector<std::size_t> all = let_go_;
  all.insert(all.end(), pinned.begin(), pinned.end());
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

void PinBorder::take_columns(std::span<const BorderColumn* const> members, const TailComplement& tail) {
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
void PinBorder::take_products() {
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
void PinBorder::take_block(std::span<const BorderColumn* const> members) {
  std::unordered_map<std::size_t, std::size_t> number;
  for (std::size_t r = 0; r < let_go_.size(); ++r) number.emplace(let_go_[r], r);
  for (std::size_t c = 0; c < let_go_.size(); ++c) {
    const SparseVector& w = members[c]->w;
    for (std::size_t e = 0; e < w.rows.size(); ++e)
      if (const auto r = number.find(w.rows[e]); r != number.end())
        border_[c * members.size() + r->second] += w.values[e];
  }
}

void PinBorder::correct(std::span<double> Ty, std::span<double> at_let_go) const {
  if (columns_.empty()) return;
  std::vector<double> t;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    t.push_back((c < at_let_go.size() ? at_let_go[c] : 0) - dot(*columns_[c].y, Ty));
  const auto order = static_cast<PetscBLASInt>(t.size());
  const PetscBLASInt one = 1;
  const char plain = 'N';
  PetscBLASInt outcome = 0;
  LAPACKgetrs_(&plain, &order, &one, border_.data(), &order, pivots_.data(), t.data(), &order, &outcome);
  for (std::size_t c = 0; c < t.size(); ++c) {
    const Column& column = columns_[c];
    for (std::size_t e = 0; e < column.head; ++e) Ty[column.y->rows[e]] -= column.y->values[e] * t[c];
    for (std::size_t e = 0; e < tail_size_; ++e) Ty[tail_begin_ + e] -= tail(c)[e] * t[c];
  }
  std::copy_n(t.begin(), at_let_go.size(), at_let_go.begin());
}

}  // namespace plastron::algebra
