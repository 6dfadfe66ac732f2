// A solve with some unknowns pinned turned into one with a few others let go or pinned, by a border of the system: with M the solve at hand,
// J the unknowns let go and E the unit vectors of those pinned anew,
//   [A   A_J   E] [x  ]   [b  ]          W = [A_J  E],  Y = M W,   t = (x_J, mu)
//   [A_J' A_JJ  ] [x_J] = [b_J],         (D - W' Y) t = (b_J, 0) - W' M b,   x = M b - Y t,   D = A_JJ and zeros.
//   [E'         ] [mu ]   [0  ]
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {

class PinBorder {
 public:
  /// Solves for several right-hand sides of the size of A at once, in place: x = M b, zero where pinned.
  using Solve = std::function<void(std::vector<double>& columns, std::size_t count)>;

  PinBorder() = default;
  /// `let_go` are pinned for M and `pinned` are not. free[i] != 0 where M's unknowns are free. A is of one rank.
  PinBorder(const Matrix::Storage& A, double shift, std::vector<std::size_t> let_go, std::vector<std::size_t> pinned,
            std::span<const char> free, const Solve& solve);
  /// False if the border has no inverse.
  bool is_regular() const { return is_regular_; }

  std::size_t size() const { return let_go_.size() + pinned_.size(); }
  /// x = M b, where b is zero but on unknowns that are free for both, becomes the solution, zero where pinned now. `at_let_go` is b_J.
  void correct(std::span<const double> at_let_go, std::span<double> x) const;
  std::span<const std::size_t> let_go() const { return let_go_; }
  std::span<const std::size_t> pinned() const { return pinned_; }

 private:
  struct Entry {
    std::size_t row;
    double value;
  };
  void take_columns(const Matrix::Storage& A, double shift, std::span<const char> free);
  double along(std::size_t column, const double* x) const;

  std::vector<std::size_t> let_go_{}, pinned_{};
  std::vector<std::vector<Entry>> columns_{};  ///< W
  std::vector<double> block_{};                ///< A_JJ
  std::vector<double> answers_{};              ///< Y
  std::vector<double> border_{};               ///< D - W' Y, factorised
  std::vector<int> pivots_{};
  bool is_regular_ = true;
};

}  // namespace plastron::algebra
