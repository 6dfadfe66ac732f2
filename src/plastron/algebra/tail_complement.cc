#include "tail_complement.hpp"

#include <petscsys.h>
// after petscsys.h, without which it does not compile
#include <petscblaslapack.h>

#include <utility>

namespace plastron::algebra {
namespace {

const char lower = 'L', plain = 'N', transposed = 'T', not_unit = 'N';
const PetscBLASInt one = 1;

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

void TailComplement::solve(std::span<double> v) const {
  if (size_ == 0) return;
  const auto n = static_cast<PetscBLASInt>(size_), m = static_cast<PetscBLASInt>(free_.size());
  const auto times_factor = [&](const char& side) {
    BLAStrmv_(&lower, &side, &not_unit, &n, factor_.data(), &n, v.data(), &one);
  };
  times_factor(plain);
  std::vector<double> z;
  z.reserve(free_.size());
  for (const std::size_t i : free_) z.push_back(v[i]);
  PetscBLASInt outcome = 0;
  if (m > 0) LAPACKpotrs_(&lower, &m, &one, free_factor_.data(), &m, z.data(), &m, &outcome);
  for (double& value : v) value = 0;
  for (std::size_t k = 0; k < free_.size(); ++k) v[free_[k]] = z[k];
  times_factor(transposed);
}

}  // namespace plastron::algebra
