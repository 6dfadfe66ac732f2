// The subproblem of an active set with the positions of pressing forces as further unknowns: a linear problem with a
// border,
//   A z = b where free,   z_i = bound_i(delta) where fixed,   sum over active i of (A z - b)_i shape_ki = F_k.
// z_k is the response to position k: A z_k = 0 where free and z_k = shape_k where fixed. z_0 is the solution at the
// present positions:
//   z = z_0 + sum_k step_k z_k,   sum_l (z_k' A z_l) step_l = F_k - R_k(z_0),
// so one factorisation serves all. A force that no active unknown carries has no equation. Its position becomes the one
// at which it first touches z. The unknowns that it touches will become active.
#pragma once
#include <plastron/contact/border.hpp>
#include <plastron/contact/subproblem.hpp>

#include <optional>
#include <vector>

namespace plastron::contact {

class PressedSubproblem {
 public:
  /// Keeps references to all of them. Without pressing forces it is a SubproblemSolver. Precondition: every force can
  /// be carried.
  PressedSubproblem(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings);
  PressedSubproblem(const PressedSubproblem&) = delete;
  PressedSubproblem& operator=(const PressedSubproblem&) = delete;

  /// Returns nothing if the set leaves a motion of the structure or of an obstacle free, or if the computation fails;
  /// failure() then gives the reason. The positions are then those of the point, and the energy includes - F delta.
  /// (collective)
  std::optional<SubproblemPoint> solve(const ActiveSet& set);
  /// Returns the point on `initial`. If that leaves a motion free, unknowns that touch at z = 0 or all bounds are
  /// active; with an indefinite matrix all bounds only if nothing is active in `initial`. `set` becomes the set of the
  /// point. (collective)
  std::optional<SubproblemPoint> solve_first(std::span<const Activity> initial, ActiveSet& set);
  Status failure() const { return failure_; }

  /// Sets the positions for the next solve() (0 at first).
  void start_from(std::vector<double> positions);
  /// The problem with its bounds at the present positions.
  const BoxProblem& box() const { return box_; }
  SubproblemSolver& subproblems() { return subproblems_; }
  /// K of the forces that meet the last set; empty if that set has no point even without forces.
  const Border& border() const { return border_; }

 private:
  /// z_k and A z_k of a force that active unknowns carry.
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
