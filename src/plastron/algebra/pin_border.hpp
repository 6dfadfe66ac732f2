// Changes a few pins of a factorised system by a border: some unknowns are released, others are pinned. L L' is the
// available factor, J are the released unknowns and E the unit vectors of the newly pinned ones:
//   [A   A_J   E] [x  ]   [b  ]          W = [A_J  E],  Y = L^{-1} W,  y = L^{-1} b,  t = (x_J, mu),
//   [A_J' A_JJ  ] [x_J] = [b_J],         (D - Y' T Y) t = (b_J, 0) - Y' T y,  L' x = T (y - Y t),  D = A_JJ and zeros,
//   [E'         ] [mu ]   [0  ]
// where T is 1 except on the tail, the unknowns eliminated last. On the tail T is solve() of tail_complement.hpp with
// their pins.
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
  /// Makes the border. `let_go` are pinned in the factor, `pinned` are not. `columns` must outlive this object. `tail`
  /// is the end of `size` unknowns.
  PinBorder(std::vector<std::size_t> let_go, std::span<const std::size_t> pinned, BorderColumns& columns,
            const TailComplement& tail, std::size_t size);
  /// Whether the border has an inverse.
  bool is_regular() const { return is_regular_; }

  std::span<const std::size_t> let_go() const { return let_go_; }
  /// Changes T y to T (y - Y t), by places in the order of elimination, and b_J to x_J.
  void correct(std::span<double> Ty, std::span<double> at_let_go) const;

 private:
  /// A column of Y. `head` of its entries are before the tail.
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
