#include <research/study/kinds.hpp>

#include <research/study/adaptivity.hpp>
#include <research/study/compare.hpp>
#include <research/study/compare_solvers.hpp>
#include <research/study/continuity.hpp>
#include <research/study/convergence.hpp>
#include <research/study/penalty.hpp>
#include <research/study/stability.hpp>
#include <research/study/thickness.hpp>

#include <algorithm>
#include <array>

namespace plastron::study {

namespace {

using Variants = decltype(Kind::variants);

Kind kind_of(std::string_view name, decltype(Kind::run) run, Variants variants = nullptr) {
  const KindName& of = *find_kind_name(name);
  return {of.name, of.question, run, of.options, variants, run == adaptivity};
}

}  // namespace

std::span<const Kind> kinds() {
  static const std::array all{
      kind_of("convergence", convergence),
      kind_of("adaptivity", adaptivity),
      kind_of("penalty", penalty, penalty_variants),
      kind_of("thickness", thickness, thickness_study_variants),
      kind_of("continuity", continuity, continuity_variants),
      kind_of("stability", stability, stability_variants),
      kind_of("soft-modes", soft_modes),
  };
  return all;
}

const Kind& comparison() {
  static constexpr Kind kind{"compare", "all formulations side by side", compare};
  return kind;
}

const Kind& solver_comparison() {
  static constexpr Kind kind{"compare-solvers", "all contact solvers side by side", compare_solvers};
  return kind;
}

const Kind* find_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, &Kind::name);
  return found == kinds().end() ? nullptr : &*found;
}

std::vector<examination::Finding> examine(const Kind& kind, const problem::Problem& problem,
                                          const StudyOptions& options) {
  std::vector<examination::Finding> findings = examination::examine(problem);
  if (examination::has_errors(findings) || !kind.variants) return findings;
  for (const Variant& variant : kind.variants(problem, options))
    for (const examination::Finding& finding : examination::examine(variant.problem))
      if (finding.severity == examination::Severity::error)
        findings.push_back(
            {examination::Severity::error, variant.what + ", which this study computes: " + finding.text});
  return findings;
}

}  // namespace plastron::study
