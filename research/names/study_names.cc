#include <research/names/study_names.hpp>

#include <algorithm>
#include <array>

namespace plastron::study {

namespace {

constexpr std::array<std::string_view, 1> of_convergence{"reference"};
constexpr std::array<std::string_view, 3> of_thickness{"factors", "steps", "load-exponent"};
constexpr std::array<std::string_view, 3> of_continuity{"samples", "size", "seed"};
constexpr std::array<std::string_view, 1> of_stability{"factors"};

}  // namespace

std::span<const KindName> kind_names() {
  static constexpr std::array all{
      KindName{"convergence", "how fast the error falls with the mesh size", of_convergence},
      KindName{"adaptivity",
               "what an accuracy costs on graded and on uniform meshes, and whether estimated errors are right"},
      KindName{"penalty", "whether the penalised solution converges as p goes to zero"},
      KindName{"thickness", "what happens as the thickness goes to zero", of_thickness},
      KindName{"continuity", "whether the solution depends continuously on load, thickness and obstacle",
               of_continuity},
      KindName{"stability", "whether the constants of coercivity and inf-sup hold as h and e go to zero", of_stability},
      KindName{"soft-modes", "which motions cost no energy without supports"},
  };
  return all;
}

const KindName* find_kind_name(std::string_view name) {
  const auto found = std::ranges::find(kind_names(), name, &KindName::name);
  return found == kind_names().end() ? nullptr : &*found;
}

bool takes_option(const KindName& kind, std::string_view option) {
  return std::ranges::find(kind.options, option) != kind.options.end();
}

std::string kinds_that_take(std::string_view option) {
  std::string names;
  for (const KindName& kind : kind_names())
    if (takes_option(kind, option)) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

}  // namespace plastron::study
