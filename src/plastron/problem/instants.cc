#include <plastron/problem/instants.hpp>

#include <algorithm>
#include <stdexcept>

namespace plastron::problem {

namespace {

double between(double from, double to, double part) { return part == 1 ? to : from + part * (to - from); }

}  // namespace

Instant between(const Instant& from, const Instant& to, double part) {
  Instant now{.step = to.step,
              .time = between(from.time, to.time, part),
              .load_factor = between(from.load_factor, to.load_factor, part),
              .support_factor = between(from.support_factor, to.support_factor, part),
              .control = to.control,
              .overlap = between(from.overlap, to.overlap, part)};
  now.part = part == 1 ? to.part : now.time - to.step;
  const auto factor = [](const Instant& instant, std::size_t k) {
    return instant.force_factors.empty() ? 1 : instant.force_factors[k];
  };
  for (std::size_t k = 0; k < std::max(from.force_factors.size(), to.force_factors.size()); ++k)
    now.force_factors.push_back(between(factor(from, k), factor(to, k), part));
  return now;
}

/// Part of the first step that is solved from the undeformed shell where parts are chosen.
constexpr double first_part = 0.125;

Instant start(const Problem& problem) {
  return {.load_factor = 0,
          .support_factor = 0,
          .force_factors = std::vector<double>(problem.shell.obstacles.all.size(), 0),
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
                  .time = static_cast<double>(s) + part,
                  .load_factor = between(before.load_factor, step.load_factor, part),
                  .support_factor = between(before.support_factor, step.support_factor, part),
                  .control = step.control ? &*step.control : nullptr,
                  .part = part,
                  .chooses_parts = step.chooses_parts};
      for (std::size_t k = 0; k < problem.shell.obstacles.all.size(); ++k) {
        const double to = step.force_factors.empty() ? 1 : step.force_factors[k];
        now.force_factors.push_back(between(before.force_factors[k], to, part));
      }
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
                           .displacement = between(start, instant.control->to, instant.part)};
}

}  // namespace plastron::problem
