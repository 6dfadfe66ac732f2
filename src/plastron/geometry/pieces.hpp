// Where an expression made of pieces (is_piecewise) has one piece only: interval arithmetic over a box of x and y shows it, so that no piece is too
// narrow to be seen. Source: Moore, Kearfott and Cloud, Introduction to Interval Analysis (2009), chapters 5 and 6.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <memory>

namespace plastron::geometry {

struct Interval {
  double low = 0, high = 0;
};

class Pieces {
 public:
  explicit Pieces(const Expression& f);

  /// No comparison, choice, abs, ... has two sides over the box, so that f is smooth there wherever it is finite. False where the arithmetic
  /// cannot tell; it can for every small box that no border of a piece crosses.
  bool is_one_over(const Interval& x, const Interval& y) const;

 private:
  struct Program;
  bool known_ =
      true;  ///< all functions of the expression have interval arithmetic here; else every box may have several pieces
  std::shared_ptr<const Program> program_{};  ///< none for an expression that is one piece
};

}  // namespace plastron::geometry
