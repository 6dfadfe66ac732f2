#include <plastron/study/kinds.hpp>

#include <plastron/study/continuity.hpp>
#include <plastron/study/convergence.hpp>
#include <plastron/study/penalty.hpp>
#include <plastron/study/stability.hpp>
#include <plastron/study/thickness.hpp>

#include <algorithm>
#include <array>

namespace plastron::study {

std::span<const Kind> kinds() {
  static constexpr std::array all{
      Kind{"convergence", "how fast the error falls with the mesh size", convergence},
      Kind{"penalty", "whether the penalised solution converges as p goes to zero", penalty},
      Kind{"thickness", "what happens as the thickness goes to zero", thickness},
      Kind{"continuity", "whether the solution depends continuously on load, thickness and obstacle", continuity},
      Kind{"stability", "whether the constants of coercivity and inf-sup hold as h and e go to zero", stability},
      Kind{"soft-modes", "which motions cost nothing once all supports are removed", soft_modes},
  };
  return all;
}

const Kind* find_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, &Kind::name);
  return found == kinds().end() ? nullptr : &*found;
}

}  // namespace plastron::study
