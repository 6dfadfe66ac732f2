#include "pin_border.hpp"

#include <petscsys.h>
// after petscsys.h, without which it does not compile
#include <petscblaslapack.h>

#include <unordered_map>
#include <utility>

namespace plastron::algebra {

PinBorder::PinBorder(const Matrix::Storage& A, double shift, std::vector<std::size_t> let_go,
                     std::vector<std::size_t> pinned, std::span<const char> free, const Solve& solve)
    : let_go_(std::move(let_go)), pinned_(std::move(pinned)) {
  const std::size_t k = size(), n = A.owned_unknowns();
  if (k == 0) return;
  take_columns(A, shift, free);
  answers_.assign(n * k, 0.0);
  for (std::size_t c = 0; c < k; ++c)
    for (const Entry& entry : columns_[c]) answers_[c * n + entry.row] = entry.value;
  solve(answers_, k);
  border_.assign(k * k, 0.0);
  for (std::size_t c = 0; c < k; ++c)
    for (std::size_t r = 0; r < k; ++r) {
      const bool is_in_block = r < let_go_.size() && c < let_go_.size();
      border_[c * k + r] = (is_in_block ? block_[c * let_go_.size() + r] : 0) - along(r, answers_.data() + c * n);
    }
  const auto order = static_cast<PetscBLASInt>(k);
  PetscBLASInt outcome = 0;
  pivots_.assign(k, 0);
  LAPACKgetrf_(&order, &order, border_.data(), &order, pivots_.data(), &outcome);
  is_regular_ = outcome == 0;
}

/// W and A_JJ. The upper half is stored: a column's part above the diagonal is found by going through all rows.
void PinBorder::take_columns(const Matrix::Storage& A, double shift, std::span<const char> free) {
  const auto m = static_cast<std::size_t>(A.block);
  const std::size_t j_count = let_go_.size();
  columns_.resize(size());
  block_.assign(j_count * j_count, 0.0);
  std::unordered_multimap<std::size_t, std::size_t> of_node;
  std::unordered_map<std::size_t, std::size_t> number;
  for (std::size_t c = 0; c < j_count; ++c) {
    of_node.emplace(let_go_[c] / m, c);
    number.emplace(let_go_[c], c);
  }
  const auto take = [&](std::size_t c, std::size_t row, double value) {
    if (row == let_go_[c]) value *= 1 + shift;
    if (const auto other = number.find(row); other != number.end())
      block_[c * j_count + other->second] = value;
    else if (free[row])
      columns_[c].push_back({row, value});
  };
  std::vector<char> is_wanted(A.global.size(), 0);
  for (const std::size_t j : let_go_) is_wanted[j / m] = 1;
  for (LocalIndex node = 0; j_count > 0 && node < A.layout->owned; ++node)
    for (std::size_t k = A.row_begin(node); k < A.row_end(node); ++k) {
      const auto row = static_cast<std::size_t>(node), column = static_cast<std::size_t>(A.column[k]);
      if (!is_wanted[row] && !is_wanted[column]) continue;
      const double* B = A.block_at(k);
      for (auto [it, end] = of_node.equal_range(row); it != end; ++it)
        for (std::size_t b = 0; b < m; ++b) {
          const std::size_t a = let_go_[it->second] % m;  // of a diagonal block only the upper half counts
          take(it->second, column * m + b, row == column && b < a ? B[b * m + a] : B[a * m + b]);
        }
      for (auto [it, end] = of_node.equal_range(column); row != column && it != end; ++it)
        for (std::size_t a = 0; a < m; ++a) take(it->second, row * m + a, B[a * m + let_go_[it->second] % m]);
    }
  for (std::size_t c = 0; c < pinned_.size(); ++c) columns_[j_count + c].push_back({pinned_[c], 1.0});
}

double PinBorder::along(std::size_t column, const double* x) const {
  double sum = 0;
  for (const Entry& entry : columns_[column]) sum += entry.value * x[entry.row];
  return sum;
}

void PinBorder::correct(std::span<const double> at_let_go, std::span<double> x) const {
  const std::size_t k = size(), n = x.size();
  if (k == 0) return;
  std::vector<double> t(k);
  for (std::size_t c = 0; c < k; ++c) t[c] = (c < at_let_go.size() ? at_let_go[c] : 0) - along(c, x.data());
  const auto order = static_cast<PetscBLASInt>(k);
  const PetscBLASInt one = 1;
  const char plain = 'N';
  PetscBLASInt outcome = 0;
  LAPACKgetrs_(&plain, &order, &one, border_.data(), &order, pivots_.data(), t.data(), &order, &outcome);
  for (std::size_t c = 0; c < k; ++c)
    for (std::size_t i = 0; i < n; ++i) x[i] -= answers_[c * n + i] * t[c];
  for (std::size_t c = 0; c < let_go_.size(); ++c) x[let_go_[c]] = t[c];
  for (const std::size_t i : pinned_) x[i] = 0;
}

}  // namespace plastron::algebra
