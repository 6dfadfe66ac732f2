#include <plastron/config/limits.hpp>

#include <algorithm>

namespace plastron::config {

const std::vector<Limit>& limits() {
  static const std::vector<Limit> all{
      {"rotations",
       {"large-displacements", "nonlinear"},
       "By default strains are linear in the displacements: no finite rotations, and no change of stiffness by "
       "membrane forces.",
       "`linearity` in `results.json`, in the summary and in `report.html`: energy and reactions of the model of "
       "finite rotations, to some per cent; a warning if they differ by 5 %",
       "`rotations = \"finite\"` in `[shell]`, with the tangent formulation"},
      {"buckling",
       {"snap-through", "stability"},
       "With small rotations the equilibrium is unique: no buckling, no snap-through. With finite rotations paths "
       "that turn back in a controlled displacement are left out.",
       "`linearity.status`, `unstable` beyond the buckling load; `linearity.buckling`, the membrane forces over the "
       "forces under which a perfect shell with the same contact buckles, with a warning from 0.5 on; `plastron modes` "
       "computes buckling loads and their shapes; with finite rotations `stability.margin`",
       "`rotations = \"finite\"`; `[[imperfection]]` for shells that are not perfect"},
      {"plasticity",
       {"yield", "yielding"},
       "The law is linear and elastic: no yielding, no rubber, no creep, no damage.",
       "`linearity.max_strain`; a warning from 2 % on (most metals yield at 0.1 to 0.5 %)",
       "compare `stress.max_von_mises` with the yield stress; use a program with plasticity"},
      {"laminates",
       {"orthotropic", "sandwich", "core", "honeycomb"},
       "Layers are bonded and share the strains of the shell: no slip, no delamination. One director for the section: "
       "faces on a soft core do not bend each on their own, which `check` says.",
       "`layers` in `results.json` has the stresses of each layer",
       "a failure criterion on `layers`; a layerwise or solid program for soft cores"},
      {"friction",
       {"mu", "friction-coefficient", "coulomb"},
       "Contact forces act along the normal of the obstacle only.",
       "supports must prevent motions along the obstacle; `check` names motions that are free",
       "supports instead of friction, or a program with friction"},
      {"self-contact",
       {},
       "Obstacles are rigid, or give by an elastic bed. Shells do not touch themselves or each other.",
       "only the deformed shape",
       "a program with deformable contact"},
      {"temperature",
       {"thermal", "heat"},
       "Temperatures are given and linear through the thickness: no conduction of heat, and no material that depends "
       "on temperature.",
       "`layers` and `stress` in `results.json` have the stresses that remain",
       "`[[temperature]]` with `mean` and `difference`; a program with thermal analysis that computes them"},
      {"vibrations",
       {"dynamics", "frequencies", "damping"},
       "There is no motion in time: loads and obstacles are slow.",
       "`plastron modes` computes natural frequencies, with contact held",
       "`vibration` in `[modes]` for natural frequencies, or a program for dynamics"},
      {"follower-loads",
       {"follower"},
       "With small rotations a pressure acts along the normal and on the area of the undeformed shell. Forces and "
       "couples keep their directions in both models.",
       "as for rotations",
       "`rotations = \"finite\"` and `follows = true` in `[[load]]`"},
      {"beams",
       {"beam", "solids", "bars", "trusses"},
       "The model has shells, springs, rigid bodies and obstacles: no beams and no solids.",
       "not shown",
       "a general program"},
      {"springs",
       {"spring", "foundation", "foundations", "elastic-foundation", "elastic-support", "bed", "elastic-bed", "bedding",
        "winkler", "subgrade", "support.elastic", "support.stiffness", "obstacle.stiffness", "rigid_body.stiffness",
        "spring.rigid-body", "spring.boundary"},
       "Springs act at points of the shell and on rigid bodies, foundations on areas and along edges, with stiffnesses "
       "that do not change, and hinges with a stiffness between joined edges: no other springs of rotations. "
       "A bed may stiffen or soften as it closes; it has no hysteresis.",
       "`foundations`, `springs` and `obstacles` in `results.json` have forces and energies",
       "`[[spring]]` at a point or on a `[[rigid_body]]`, `[[foundation]]` under an area or along an edge (also one "
       "that a rigid body carries), `stiffness` of a `[[join]]`, or `bed` of an `[[obstacle]]`"},
      {"free-bodies",
       {"free", "free-body", "free-free", "unsupported", "inertia-relief"},
       "Supports, springs, foundations or pressed obstacles prevent all rigid motions: no shell in free flight, and no "
       "balance of loads by inertia.",
       "an error of `check`, with the motions that are free",
       "for frequencies of a free shell a `[[foundation]]` with a small `stiffness` in all directions: the six lowest "
       "frequencies are those on the foundation; for loads in equilibrium `[[support]]` at three points"},
      {"point-loads",
       {"point-load", "point-force", "point-forces", "nodal-load", "nodal-loads", "nodal-force", "nodal-forces",
        "concentrated-load", "concentrated-loads", "concentrated-force", "concentrated-forces", ".force", ".forces",
        ".moment", ".moments", "load.at", "load.node", "load.nodes"},
       "A force or a moment at a point is spread over the places nearer than a radius: a force at a point would move "
       "it "
       "without limit as the mesh is refined.",
       "not shown",
       "`point`, `radius` and `total` or `moment` in `[[load]]`, or a small obstacle with a `force`"},
      {"load-cases",
       {"load-case", "loadcase", "loadcases", "combinations"},
       "Load cases start from the undeformed shell, and a file has either load cases or steps. Envelopes have fields "
       "only where their cases have one mesh.",
       "`history` and `envelopes` in `results.json`",
       "`[[case]]` and `[[envelope]]`; `refinements` in the place of `[accuracy]` for envelopes of fields; `[[step]]` "
       "for loads that follow each other"},
      {"T-joints",
       {"stiffeners"},
       "`[[join]]` joins edges. An edge cannot be joined to the inside of a shell.",
       "an error of `check`",
       "divide the other shell there into two pieces, or use a CAD file or a mesh in space, where three or more cells "
       "may share a "
       "side"},
  };
  return all;
}

const Limit* limit_of(std::string_view section, std::string_view given) {
  std::string word(given);
  std::ranges::replace(word, '_', '-');
  const std::string key = std::string(section) + "." + word;
  const auto names = [&](const Limit& limit) {
    return limit.name == word || std::ranges::find(limit.aliases, word) != limit.aliases.end() ||
           std::ranges::find(limit.aliases, key) != limit.aliases.end();
  };
  const auto found = std::ranges::find_if(limits(), names);
  return found == limits().end() ? nullptr : &*found;
}

}  // namespace plastron::config
