// The subproblem of an active set with the positions of pressing forces as further unknowns: a linear problem with a border,
//   A z = b where free,   z_i = bound_i(delta) where held,   sum over active i of (A z - b)_i shape_ki = F_k.
// With z_k the answer to position k, A z_k = 0 where free and z_k = shape_k where held, and z_0 the solution at the positions at hand,
//   z = z_0 + sum_k step_k z_k,   sum_l (z_k' A z_l) step_l = F_k - R_k(z_0),
// so one factorisation serves all. A force that no active unknown carries has no equation: its position becomes the one at which it
// first touches z, and what it touches is to become active.
#pragma once
#include <plastron/contact/border.hpp>
#include <plastron/contact/subproblem.hpp>

#include <optional>
#include <vector>

namespace plastron::contact {

class PressedSubproblem {
 public:
  /// Refers to all of them; without pressing forces it is a SubproblemSolver. Every force can be carried.
  PressedSubproblem(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings);
  PressedSubproblem(const PressedSubproblem&) = delete;
  PressedSubproblem& operator=(const PressedSubproblem&) = delete;

  /// Nothing if the set leaves a motion free, of the structure or of an obstacle, or it cannot be computed; failure() then tells which. The
  /// positions stay at the point's, and the energy holds - F delta. (collective)
  std::optional<SubproblemPoint> solve(const ActiveSet& set);
  /// The point on `initial` or, where that leaves a motion free, with what touches at z = 0 or every bound active; `set` becomes the one
  /// that has it. (collective)
  std::optional<SubproblemPoint> solve_first(std::span<const Activity> initial, ActiveSet& set);
  Status failure() const { return failure_; }

  /// Where the next solve() begins. (0 at first)
  void start_from(std::vector<double> positions);
  /// The problem with its bounds where the positions are.
  const BoxProblem& box() const { return box_; }
  SubproblemSolver& subproblems() { return subproblems_; }
  /// K of the forces that the last set met; of none where it had no point without them either.
  const Border& border() const { return border_; }

 private:
  /// z_k and A z_k of a force that is met.
  struct Response {
    std::size_t force;
    algebra::Vector z, forces;
  };
  std::optional<std::vector<Response>> responses(const ActiveSet& set);
  Border border_of(const std::vector<Response>& responses) const;
  std::optional<SubproblemPoint> settle(const ActiveSet& set, const std::vector<Response>& responses,
                                        SubproblemPoint point);
  void finish(const ActiveSet& set, SubproblemPoint& point);

  const BoxProblem& problem_;
  BoxProblem box_;
  std::vector<double> positions_;
  SubproblemSolver subproblems_;
  Border border_{};
  Status failure_ = Status::singular;
};

}  // namespace plastron::contact
