#include <plastron/study/kinds.hpp>

#include <plastron/study/compare.hpp>
#include <plastron/study/compare_solvers.hpp>
#include <plastron/study/continuity.hpp>
#include <plastron/study/convergence.hpp>
#include <plastron/study/penalty.hpp>
#include <plastron/study/stability.hpp>
#include <plastron/study/thickness.hpp>

#include <algorithm>
#include <array>

namespace plastron::study {

namespace {

constexpr std::array<std::string_view, 1> of_convergence{"reference"};
constexpr std::array<std::string_view, 3> of_thickness{"factors", "steps", "load-exponent"};
constexpr std::array<std::string_view, 3> of_continuity{"samples", "size", "seed"};
constexpr std::array<std::string_view, 1> of_stability{"factors"};

}  // namespace

std::span<const Kind> kinds() {
  static constexpr std::array all{
      Kind{"convergence", "how fast the error falls with the mesh size", convergence, of_convergence},
      Kind{"penalty", "whether the penalised solution converges as p goes to zero", penalty, {}, penalty_variants},
      Kind{"thickness", "what happens as the thickness goes to zero", thickness, of_thickness,
           thickness_study_variants},
      Kind{"continuity", "whether the solution depends continuously on load, thickness and obstacle", continuity,
           of_continuity, continuity_variants},
      Kind{"stability", "whether the constants of coercivity and inf-sup hold as h and e go to zero", stability,
           of_stability, stability_variants},
      Kind{"soft-modes", "which motions cost nothing once all supports are removed", soft_modes},
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

bool takes_option(const Kind& kind, std::string_view option) {
  return std::ranges::find(kind.options, option) != kind.options.end();
}

std::string kinds_that_take(std::string_view option) {
  std::string names;
  for (const Kind& kind : kinds())
    if (takes_option(kind, option)) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

std::vector<examination::Finding> examine(const Kind& kind, const computation::Problem& problem,
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
