// The unknowns eliminated last, after all others. The factor's last block L gives their Schur complement S = L L',
// dense. Pinning some of them changes S only: the others F get the factor of S_FF.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace plastron::algebra {

class TailComplement {
 public:
  TailComplement() = default;
  /// Takes L by columns, `size` x `size`, zero above the diagonal.
  TailComplement(std::size_t size, std::vector<double> factor);

  /// Factorises S without the pinned ones. Returns false if a pivot is not positive.
  bool pin(const std::vector<char>& pinned);
  /// Solves in place, for each column of size(). Input is the part of L^{-1} b after the elimination of the others.
  /// Output is L' z with S_FF z_F = b_F and z = 0 where pinned.
  void solve(std::span<double> columns) const;
  std::size_t size() const { return size_; }

 private:
  std::size_t size_ = 0;
  std::vector<double> factor_{};      ///< L
  std::vector<double> complement_{};  ///< S, its lower half
  std::vector<std::size_t> free_{};
  std::vector<double> free_factor_{};  ///< factor of S_FF
};

}  // namespace plastron::algebra
