// A solve with some unknowns pinned turned into one with a few others let go or pinned, by a border of the system: with L L' the factor at hand,
// J the unknowns let go and E the unit vectors of those pinned anew,
//   [A   A_J   E] [x  ]   [b  ]          W = [A_J  E],  Y = L^{-1} W,  y = L^{-1} b,  t = (x_J, mu),
//   [A_J' A_JJ  ] [x_J] = [b_J],         (D - Y' T Y) t = (b_J, 0) - Y' T y,  L' x = T (y - Y t),  D = A_JJ and zeros,
//   [E'         ] [mu ]   [0  ]
// where T is 1 but on the tail, the unknowns eliminated last, where it is tail_complement.hpp's solve() with their pins.
// Includes CHOLMOD: for .cc files only.
#pragma once
#include <span>
#include <vector>

#include "border_columns.hpp"
#include "tail_complement.hpp"

namespace plastron::algebra {

class PinBorder {
 public:
  PinBorder() = default;
  /// `let_go` are pinned in the factor, `pinned` are not; `columns` must outlive this object. `tail` comes last of `size` unknowns.
  PinBorder(std::vector<std::size_t> let_go, std::span<const std::size_t> pinned, BorderColumns& columns,
            const TailComplement& tail, std::size_t size);
  /// False if the border has no inverse.
  bool is_regular() const { return is_regular_; }

  std::span<const std::size_t> let_go() const { return let_go_; }
  /// From T y to T (y - Y t), by places in the order of elimination, and from b_J to x_J.
  void correct(std::span<double> Ty, std::span<double> at_let_go) const;

 private:
  /// Of Y. So many of its entries come before the tail.
  struct Column {
    const SparseVector* y;
    std::size_t head;
  };
  void take_columns(std::span<const BorderColumn* const> members, const TailComplement& tail);
  void take_products();
  void take_block(std::span<const BorderColumn* const> members);
  std::span<const double> tail(std::size_t c) const { return std::span(tails_).subspan(c * tail_size_, tail_size_); }

  std::vector<std::size_t> let_go_{};
  std::vector<Column> columns_{};
  std::size_t tail_begin_ = 0, tail_size_ = 0;
  std::vector<double> tails_{};   ///< T Y on the tail, by columns
  std::vector<double> border_{};  ///< D - Y' T Y, factorised
  std::vector<int> pivots_{};
  bool is_regular_ = true;
};

}  // namespace plastron::algebra
