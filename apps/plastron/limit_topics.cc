// The limits of the program, as in docs/limits.md: a test compares both.
#include "layout.hpp"
#include "topic.hpp"

#include <vector>

namespace plastron::app {

namespace {

struct Limit {
  std::string name;
  std::vector<std::string> aliases;
  std::string left_out, shows, advice;
};

const std::vector<Limit>& limits() {
  static const std::vector<Limit> all{
      {"rotations",
       {"large-displacements", "nonlinear"},
       "Strains are linear in the displacements. Finite rotations, and membrane forces that displacements change, are "
       "left out.",
       "`linearity` in `results.json`, the summary and the top of `report.html`; a warning where 5 % of the energy is "
       "left out",
       "a smaller load, a thicker shell, or a program with finite rotations"},
      {"buckling",
       {"snap-through", "stability"},
       "No equilibrium branches off: there is no snap-through and nothing after buckling.",
       "`linearity.buckling`, the membrane forces over those under which a perfect shell buckles with the contact that "
       "was found; a warning from 0.5 on",
       "a buckling analysis of another program, with imperfections"},
      {"plasticity",
       {"yield", "yielding"},
       "The law is linear and isotropic: no yielding, no rubber, no creep, no damage.",
       "`linearity.max_strain`; a warning from 2 %, where most metals have yielded long before (0.1 to 0.5 %)",
       "compare `stress.max_von_mises` with the yield stress; a program with plasticity"},
      {"laminates",
       {"orthotropic"},
       "There are no layers and no directions: a region has one E and one nu.",
       "nothing shows it",
       "a program for laminates"},
      {"friction",
       {},
       "Contact pushes along the obstacle's normal only.",
       "motions along the obstacle must be held by supports, and `check` names those that are not",
       "supports in place of friction, or a program with friction"},
      {"self-contact",
       {},
       "Obstacles are rigid. Shells do not touch themselves or each other.",
       "nothing shows it: look at the deformed shape",
       "a program with deformable contact"},
      {"temperature",
       {"thermal"},
       "There are no thermal strains and no prestress.",
       "nothing shows it",
       "a program with thermal strains"},
      {"vibrations",
       {"dynamics", "frequencies"},
       "There is no inertia: loads and obstacles are slow.",
       "nothing shows it",
       "a program for dynamics"},
      {"follower-loads",
       {"follower"},
       "A pressure keeps the direction of the undeformed normal, and its area.",
       "the same as rotations",
       "a smaller load, or a program with finite rotations"},
      {"beams",
       {"springs", "solids"},
       "There are shells, rigid bodies and rigid obstacles: no beams, solids or springs.",
       "nothing shows it",
       "a general program"},
      {"T-joints",
       {"stiffeners"},
       "`[[join]]` joins edges. An edge cannot be joined to the inside of a shell.",
       "an error of `check`",
       "divide the other shell into two pieces that meet there"},
  };
  return all;
}

std::string text_of(const Limit& limit) {
  constexpr std::size_t width = 9;
  return paragraph(limit.left_out, 2) + "\n" + row("shows", width, limit.shows) + row("do", width, limit.advice) +
         row("page", width, "docs/limits.md");
}

}  // namespace

std::vector<Topic> limit_topics() {
  std::vector<Topic> topics;
  for (const Limit& limit : limits())
    topics.push_back({limit.name, "cannot be computed", limit.aliases, [&limit] { return text_of(limit); }});
  return topics;
}

std::string limit_overview() {
  std::string names;
  for (const Limit& limit : limits()) names += (names.empty() ? "" : ", ") + limit.name;
  return "What it cannot do (docs/limits.md):\n" + paragraph(names, 2);
}

}  // namespace plastron::app
