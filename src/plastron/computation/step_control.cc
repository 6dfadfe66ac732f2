#include <plastron/computation/step_control.hpp>

#include <algorithm>

namespace plastron::computation {

namespace {

/// Number of Newton steps after which the next part is as long as the last one.
constexpr double usual_steps = 7;

/// Returns the factor between the next part and the last one.
double growth(int newton_steps, const Pace& pace) {
  if (!pace.follows_iteration) return 2;
  return std::clamp(usual_steps / std::max(newton_steps, 1), 0.25, 2.0);
}

/// Whether a shorter part can have another status. The linear contact problem of a longer part is no harder.
bool may_be_too_long(const LevelResult& level) {
  using enum contact::Status;
  const contact::Status status = level.record.status;
  return level.solution.discrete->depends_on_path() && status != interrupted && status != infeasible &&
         status != not_finite && status != not_carried;
}

}  // namespace

Pace pace_of(const problem::Instant& to) {
  if (!to.chooses_parts) return {.least = 0x1p-5};
  return {.first = 0.125,
          .longest = problem::Step::longest_chosen_part,
          .least_before_jump = 0x1p-6,
          .follows_iteration = true};
}

void PartLength::accept(double part, int newton_steps) {
  double next = part * growth(newton_steps, pace_);
  if (next >= part)
    longer_ = {};
  else if (next < pace_.least_by_iteration || (part < longer_.length && newton_steps >= longer_.steps))
    next = part;
  else
    longer_ = {part, newton_steps};
  length_ = std::min(next, pace_.longest);
}

Attempt judged(const LevelResult& level, double part, const Pace& pace) {
  using enum contact::Status;
  const bool is_found = level.record.status == solved || level.record.status == inaccurate;
  const bool is_accepted = is_found && !(level.record.has_jumped && part > pace.least_before_jump) &&
                           !(level.passes && part > pace.least_before_passing);
  return {.is_accepted = is_accepted,
          .may_go_on = is_found || (part > pace.least && may_be_too_long(level)),
          .newton_steps = level.record.linearisations};
}

bool go_in_parts(Run& run, const problem::Instant& from, const problem::Instant& to, const Pace& pace,
                 const Solve& solve) {
  double done = 0;
  PartLength length(pace);
  while (done < 1) {
    // A short rest joins the last part.
    const double rest = 1 - done;
    double next = rest <= std::min(1.25 * length(), pace.longest) ? 1 : done + length();
    next = std::min(next, next_part(*run.solution().discrete, run.solution().nodal.y, from, to, done));
    if (run.is_interrupted() || !run.has_time_for(to)) return false;
    const Departure departure =
        run.departure(to, run.expected_contact(next < 1 || pace.follows_iteration ? nullptr : &to));
    for (;;) {
      const problem::Instant& instant = next == 1 ? to : run.keep(problem::between(from, to, next));
      const Attempt attempt = solve(instant, departure, next - done);
      if (!attempt.may_go_on) return false;
      if (attempt.is_accepted) {
        length.accept(next - done, attempt.newton_steps);
        break;
      }
      next = done + (next - done) / 2;
    }
    done = next;
  }
  return true;
}

}  // namespace plastron::computation
