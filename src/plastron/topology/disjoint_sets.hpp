// Disjoint sets of numbers, joined pair by pair.
#pragma once
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace plastron::topology {

/// Disjoint sets of 0 to n - 1; the smallest member of a set represents it.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) {
    i = of(i);
    j = of(j);
    if (i < j) std::swap(i, j);
    parent_[i] = j;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace plastron::topology
