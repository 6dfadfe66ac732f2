#include <research/study/kinds.hpp>

#include <research/study/studies.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plastron::study {

std::span<const Kind> kinds() {
  static constexpr std::array all{
      Kind{.name = "convergence", .run = convergence, .takes_finite_rotations = true},
      Kind{.name = "adaptivity", .run = adaptivity, .grades_meshes = true, .takes_finite_rotations = true},
      Kind{"penalty", penalty, penalty_variants},
      Kind{"thickness", thickness, thickness_study_variants},
      Kind{"continuity", continuity, continuity_variants},
      Kind{"stability", stability, stability_variants},
      Kind{"soft-modes", soft_modes},
  };
  return all;
}

const Kind& comparison() {
  static constexpr Kind kind{"compare", compare};
  return kind;
}

const Kind& solver_comparison() {
  static constexpr Kind kind{"compare-solvers", compare_solvers};
  return kind;
}

const Kind* find_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, &Kind::name);
  return found == kinds().end() ? nullptr : &*found;
}

std::vector<examination::Finding> examine(const Kind& kind, const problem::Problem& problem,
                                          const StudyOptions& options) {
  std::vector<examination::Finding> findings = examination::examine(problem);
  if (problem.shell.rotations == element::Rotations::finite && !kind.takes_finite_rotations)
    findings.push_back({.severity = examination::Severity::error,
                        .text = fmt::format("{} examines the linear model, and the case has finite rotations; write "
                                            "rotations = \"small\" in [shell]",
                                            kind.name)});
  if (examination::has_errors(findings) || !kind.variants) return findings;
  for (const Variant& variant : kind.variants(problem, options))
    for (const examination::Finding& finding : examination::examine(variant.problem))
      if (finding.severity == examination::Severity::error)
        findings.push_back(
            {examination::Severity::error, variant.what + ", which this study computes: " + finding.text});
  return findings;
}

}  // namespace plastron::study
