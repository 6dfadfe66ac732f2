// Expressions that may consist of pieces with jumps or kinks, and boxes over which they have a single piece. Interval arithmetic over a box of
// the variables detects even the narrowest piece. Source: Moore, Kearfott and Cloud, Introduction to Interval Analysis
// (2009), chapters 5 and 6.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <memory>

namespace plastron::geometry {

/// Whether the text has a comparison, a choice or one of abs, atan2, max, min, rint, sign, step. Without these it is
/// smooth wherever it is finite.
bool is_piecewise(const Expression& f);

struct Interval {
  double low = 0, high = 0;
};

/// Ranges of the variables of an expression.
struct Box {
  Interval x{}, y{}, X{}, Y{}, Z{};
};

class Pieces {
 public:
  explicit Pieces(const Expression& f);

  /// Whether no comparison, choice, abs, ... takes two sides over the box, so that f is smooth there wherever it is
  /// finite. False if the arithmetic cannot decide. It can decide for every sufficiently small box that no border of
  /// a piece crosses.
  bool is_one_over(const Box& box) const;

 private:
  struct Program;
  bool known_ =
      true;  ///< true if interval arithmetic covers all functions of the text; else every box may have several pieces
  std::shared_ptr<const Program> program_{};  ///< empty for an expression of one piece
};

}  // namespace plastron::geometry
