#include <plastron/contact/face_preconditioner.hpp>
#include <plastron/contact/subproblem.hpp>

namespace plastron::contact {

Status FacePreconditioner::pin(const BoxProblem& problem, const ActiveSet& set, bool detect_free_motions) {
  pinned_ = held(set);
  const algebra::Pinning pinning = preconditioner_.pin(pinned_, problem.shift);
  if (pinning != algebra::Pinning::done) return failure_of(pinning);
  if (detect_free_motions && preconditioner_.softest_motion(problem.apply, pinned_, diagonal_).is_free())
    return Status::singular;
  return Status::solved;
}

void FacePreconditioner::apply(const algebra::Vector& r, algebra::Vector& z) const {
  on_free_ = r;
  for (std::size_t i = 0; i < pinned_.size(); ++i)
    if (pinned_[i]) on_free_.owned()[i] = 0;
  preconditioner_.apply(on_free_, z);
  for (std::size_t i = 0; i < pinned_.size(); ++i)
    if (pinned_[i]) z.owned()[i] = r.owned()[i] / diagonal_.owned()[i];
}

}  // namespace plastron::contact
