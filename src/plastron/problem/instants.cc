#include <plastron/problem/instants.hpp>

#include <algorithm>
#include <stdexcept>

namespace plastron::problem {

namespace {

double between(double from, double to, double part) { return part == 1 ? to : from + part * (to - from); }

energy::Factors between(const energy::Factors& from, const energy::Factors& to, double part) {
  energy::Factors now{.time = between(from.time, to.time, part),
                      .loads = between(from.loads, to.loads, part),
                      .supports = between(from.supports, to.supports, part)};
  for (std::size_t k = 0; k < std::max(from.forces.size(), to.forces.size()); ++k)
    now.forces.push_back(between(from.force(k), to.force(k), part));
  for (std::size_t k = 0; k < to.named.size(); ++k)
    now.named.push_back(between(from.named.empty() ? 0 : from.named[k], to.named[k], part));
  now.released = to.released;
  return now;
}

}  // namespace

Instant between(const Instant& from, const Instant& to, double part) {
  Instant now{.step = to.step,
              .factors = between(from.factors, to.factors, part),
              .control = to.control,
              .overlap = between(from.overlap, to.overlap, part)};
  now.part = part == 1 ? to.part : now.factors.time - to.step;
  return now;
}

/// Part of the first step that is solved from the undeformed shell where parts are chosen.
constexpr double first_part = 0.125;

Instant start(const Problem& problem) {
  return {.factors = {.loads = 0, .supports = 0, .forces = std::vector<double>(problem.shell.obstacles.all.size(), 0)},
          .overlap = 1};
}

std::vector<Instant> instants(const Problem& problem) {
  if (problem.steps.empty()) return {Instant{}};
  std::vector<Instant> all;
  Instant before = start(problem);
  for (std::size_t s = 0; s < problem.steps.size(); ++s) {
    const Step& step = problem.steps[s];
    std::vector<double> parts;
    if (step.chooses_parts && s == 0) parts.push_back(first_part);
    for (int j = 1; j <= step.parts; ++j) parts.push_back(static_cast<double>(j) / step.parts);
    for (const double part : parts) {
      Instant now{.step = static_cast<int>(s),
                  .factors = between(before.factors, step.factors, part),
                  .control = step.control ? &*step.control : nullptr,
                  .part = part,
                  .chooses_parts = step.chooses_parts};
      now.factors.time = static_cast<double>(s) + part;
      all.push_back(std::move(now));
    }
    before = all.back();
  }
  return all;
}

std::optional<assembly::Control> control_of(const Problem& problem, const Instant& instant, double start) {
  if (!instant.control) return {};
  const auto probe = std::ranges::find(problem.probes, instant.control->probe, &Probe::name);
  if (probe == problem.probes.end()) throw std::logic_error("the probe of a control was not checked");
  return assembly::Control{.at = probe->at,
                           .direction = instant.control->direction,
                           .displacement = between(start, instant.control->to, instant.part),
                           .factor = instant.control->factor};
}

}  // namespace plastron::problem
