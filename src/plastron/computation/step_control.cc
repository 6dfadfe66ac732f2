#include <plastron/computation/step_control.hpp>

#include <plastron/computation/passage.hpp>

#include <algorithm>

namespace plastron::computation {

namespace {

constexpr double first_part = 0.125;
/// Parts of a step that are not divided further: where there is no equilibrium, and where the shell jumps.
constexpr double least_part = 0x1p-10, least_part_before_jump = 0x1p-6;
/// Number of Newton steps after which the next part is as long as the last one.
constexpr double usual_steps = 7;

/// Returns the factor between the next part and the last one.
double growth(int newton_steps) { return std::clamp(usual_steps / std::max(newton_steps, 1), 0.25, 2.0); }

/// Whether a shorter part can have another status.
bool may_be_too_long(contact::Status status) {
  using enum contact::Status;
  return status != interrupted && status != infeasible && status != not_finite && status != not_carried;
}

}  // namespace

Attempt judged(const Level& level, double part) {
  using enum contact::Status;
  const bool is_found = level.status == solved || level.status == inaccurate;
  const bool is_accepted = is_found && !(level.has_jumped && part > least_part_before_jump);
  return {.is_accepted = is_accepted,
          .may_go_on = is_found || (part > least_part && may_be_too_long(level.status)),
          .newton_steps = level.linearisations};
}

bool go_in_parts(Run& run, const problem::Instant& from, const problem::Instant& to, const Solve& solve) {
  double done = 0, length = first_part;
  while (done < 1) {
    // A short rest joins the last part.
    const double longest = problem::Step::longest_chosen_part, rest = 1 - done;
    double next = rest <= std::min(1.25 * length, longest) ? 1 : done + length;
    next = std::min(next, next_part(*run.solution().discrete, run.solution().nodal.y, from, to, done));
    if (run.is_interrupted() || !run.has_time_for(to)) return false;
    const Departure departure = run.departure(to, contact_trend(*run.solution().discrete, run.solution().nodal));
    for (;;) {
      const problem::Instant& instant = next == 1 ? to : run.keep(problem::between(from, to, next));
      const Attempt attempt = solve(instant, departure, next - done);
      if (!attempt.may_go_on) return false;
      if (attempt.is_accepted) {
        length = std::min((next - done) * growth(attempt.newton_steps), longest);
        break;
      }
      next = done + (next - done) / 2;
    }
    done = next;
  }
  return true;
}

}  // namespace plastron::computation
