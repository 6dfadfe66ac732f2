// The common frame of searches that call a contact solver many times: for the positions of pressed obstacles, or for the
// multipliers of equations.
#pragma once
#include <plastron/contact/searches.hpp>

#include <optional>
#include <utility>

namespace plastron::contact {

class OuterSearch {
 public:
  OuterSearch(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings,
              const Observer& observer, SolverFunction& box_solver, bool is_safeguard, BoxSolution& solution)
      : problem_(problem),
        preconditioner_(preconditioner),
        settings_(settings),
        observer_(observer),
        box_solver_(box_solver),
        is_safeguard_(is_safeguard),
        solution_(solution) {}

 protected:
  void end(Status status) {
    solution_.status = status;
    has_ended_ = true;
  }
  std::nullopt_t no_more(Status status) {
    end(status);
    return std::nullopt;
  }

  void count(Iteration iteration) {
    iteration.safeguarded |= is_safeguard_;
    solution_.iterations.push_back(iteration);
    if (observer_.iteration) observer_.iteration(iteration);
  }

  /// Returns the settings of the solver's next call; nothing if the iterations are used up or the caller wants an end.
  std::optional<Settings> settings_left() {
    Settings left = settings_;
    left.max_iterations -= static_cast<int>(solution_.iterations.size());
    if (left.max_iterations <= 0) return no_more(Status::iteration_limit);
    if (!solution_.iterations.empty() && observer_.wants_to_stop()) return no_more(Status::interrupted);
    return left;
  }

  /// Stores a subproblem's point as the solution so far and counts an iteration. Returns the number of changes.
  std::int64_t store(SubproblemPoint point, const ActiveSet& set, const Verdict& verdict) {
    const std::int64_t changes = record(problem_, std::move(point), set, verdict, {}, solution_);
    const Iteration last = solution_.iterations.back();
    solution_.iterations.pop_back();
    count(last);
    return changes;
  }

  const BoxProblem& problem_;
  algebra::Preconditioner& preconditioner_;
  const Settings& settings_;
  const Observer& observer_;
  SolverFunction& box_solver_;
  bool is_safeguard_;
  BoxSolution& solution_;
  bool has_ended_ = false;
  double length_ = 1;  ///< length of the last step
};

}  // namespace plastron::contact
