#include "tail_complement.hpp"

#include <petscsys.h>
// must follow petscsys.h, without which it does not compile
#include <petscblaslapack.h>

#include <algorithm>
#include <utility>

namespace plastron::algebra {
namespace {

const char lower = 'L', plain = 'N', transposed = 'T';

}  // namespace

TailComplement::TailComplement(std::size_t size, std::vector<double> factor)
    : size_(size), factor_(std::move(factor)), complement_(size * size) {
  if (size_ == 0) return;
  const double unit = 1, zero = 0;
  const auto n = static_cast<PetscBLASInt>(size_);
  BLASsyrk_(&lower, &plain, &n, &n, &unit, factor_.data(), &n, &zero, complement_.data(), &n);
}

bool TailComplement::pin(const std::vector<char>& pinned) {
  free_.clear();
  for (std::size_t i = 0; i < size_; ++i)
    if (!pinned[i]) free_.push_back(i);
  const std::size_t n = free_.size();
  free_factor_.resize(n * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) free_factor_[j * n + i] = complement_[free_[j] * size_ + free_[i]];
  if (n == 0) return true;
  const auto order = static_cast<PetscBLASInt>(n);
  PetscBLASInt outcome = 0;
  LAPACKpotrf_(&lower, &order, free_factor_.data(), &order, &outcome);
  return outcome == 0;
}

void TailComplement::solve(std::span<double> columns) const {
  if (columns.empty()) return;
  const std::size_t count = columns.size() / size_;
  const auto n = static_cast<PetscBLASInt>(size_), m = static_cast<PetscBLASInt>(free_.size()),
             k = static_cast<PetscBLASInt>(count);
  const double unit = 1, zero = 0;
  std::vector<double> product(columns.size()), z;
  BLASgemm_(&plain, &plain, &n, &k, &n, &unit, factor_.data(), &n, columns.data(), &n, &zero, product.data(), &n);
  z.reserve(free_.size() * count);
  for (std::size_t c = 0; c < count; ++c)
    for (const std::size_t i : free_) z.push_back(product[c * size_ + i]);
  PetscBLASInt outcome = 0;
  if (m > 0) LAPACKpotrs_(&lower, &m, &k, free_factor_.data(), &m, z.data(), &m, &outcome);
  std::ranges::fill(product, 0.0);
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t i = 0; i < free_.size(); ++i) product[c * size_ + free_[i]] = z[c * free_.size() + i];
  BLASgemm_(&transposed, &plain, &n, &k, &n, &unit, factor_.data(), &n, product.data(), &n, &zero, columns.data(), &n);
}

}  // namespace plastron::algebra
