// Parts of a step: shorter where an obstacle may pass through the shell, where the iteration finds no equilibrium or where the
// shell jumps to another one; longer where few Newton steps suffice.
#pragma once
#include <plastron/computation/run.hpp>

#include <functional>

namespace plastron::computation {

/// Result of an attempt to solve an instant.
struct Attempt {
  bool is_accepted = false;
  bool may_go_on = false;  ///< a shorter part may be tried, or the next one
  int newton_steps = 0;
};

/// How the parts of a way are chosen.
struct Pace {
  double first = 1, longest = 1;         ///< parts of the way
  double least = 0x1p-10;                ///< not divided further
  double least_before_jump = 1;          ///< not divided further where the shell jumps
  double least_before_passing = 0x1p-7;  ///< not divided further where an obstacle may pass
  bool follows_iteration = false;        ///< few Newton steps lengthen the parts, many shorten them
  double least_by_iteration = 0x1p-7;    ///< not shortened further because of many Newton steps
};

/// The pace of a step whose parts are chosen, and of one whose parts are given: these are divided only if they fail.
Pace pace_of(const problem::Instant& to);
/// The pace from the undeformed shell, where one part has failed.
inline constexpr Pace from_start{.first = 0.25, .least_before_jump = 0x1p-6, .follows_iteration = true};

/// Length of the next part, by the Newton steps that the parts before have taken.
class PartLength {
 public:
  explicit PartLength(const Pace& pace) : pace_(pace), length_(pace.first) {}

  double operator()() const { return length_; }
  /// A part of this length was accepted after so many Newton steps. Many steps are no reason to shorten parts further once that spares
  /// no steps: rounds that lift bounds take some however short a part is.
  void accept(double part, int newton_steps);

 private:
  struct Part {
    double length = 0;
    int steps = 0;
  };
  Pace pace_;
  double length_;
  Part longer_{};  ///< the part before the last shortening
};

/// Judges a level at the end of a part of this length. Failures, jumps and obstacles that may have passed are rejected as
/// long as a shorter part can be tried. In the end a jump is accepted: the shell snaps there.
Attempt judged(const LevelResult& level, double part, const Pace& pace);

/// Solves an instant from a departure, after a part of the way of this length. After a rejection there is a solution at hand,
/// which nothing uses.
using Solve = std::function<Attempt(const problem::Instant& instant, const Departure& departure, double part)>;

/// Goes from the solution at hand, that of `from`, to another instant (collective).
bool go_in_parts(Run& run, const problem::Instant& from, const problem::Instant& to, const Pace& pace,
                 const Solve& solve);

}  // namespace plastron::computation
