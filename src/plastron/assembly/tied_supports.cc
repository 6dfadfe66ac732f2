#include <plastron/assembly/handed_supports.hpp>
#include <plastron/assembly/tied_supports.hpp>

namespace plastron::assembly {

void hand_to_masters(const fem::Space& space, std::vector<NodeSupport>& supports) {
  if (!space.has_ties) return;
  const algebra::Layout& layout = *space.layout;
  HandedSupports handed;
  for (const fem::Tie& tie : space.ties) {
    if (tie.node >= layout.owned) continue;
    NodeSupport& own = supports[static_cast<std::size_t>(tie.node)];
    if (tie.masters.size() == 1) {
      const auto master = layout.global(tie.masters[0].first);
      handed.add_displacement(master, own.displacement, own.displacement_scale);
      handed.add_rotation(master, own.rotation, own.rotation_scale);
    }
    own = {};
  }
  handed.deliver(layout, supports);
}

}  // namespace plastron::assembly
