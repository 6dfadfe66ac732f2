#include <plastron/assembly/tied_supports.hpp>

#include <algorithm>

namespace plastron::assembly {

namespace {

/// master, 0 for u and 1 for r, direction, value, scale.
constexpr std::size_t handed_size = 7;

void hand(std::int64_t master, int unknown, const std::vector<std::pair<Vector3d, double>>& rows, double scale,
          std::vector<double>& out) {
  for (const auto& [d, value] : rows)
    out.insert(out.end(), {static_cast<double>(master), static_cast<double>(unknown), d[0], d[1], d[2], value, scale});
}

}  // namespace

void hand_to_masters(const fem::Space& space, std::vector<NodeSupport>& supports) {
  if (!space.has_ties) return;
  const algebra::Layout& layout = *space.layout;
  std::vector<double> handed;
  for (const fem::Tie& tie : space.ties) {
    if (tie.node >= layout.owned) continue;
    NodeSupport& own = supports[static_cast<std::size_t>(tie.node)];
    if (tie.masters.size() == 1) {
      const auto master = layout.global(tie.masters[0].first);
      hand(master, 0, own.displacement, own.displacement_scale, handed);
      hand(master, 1, own.rotation, own.rotation_scale, handed);
    }
    own = {};
  }
  const auto all = algebra::gather_over_ranks(handed, layout.comm);
  for (std::size_t i = 0; i < all.size(); i += handed_size) {
    const auto master = static_cast<std::int64_t>(all[i]) - layout.first;
    if (master < 0 || master >= layout.owned) continue;
    NodeSupport& at = supports[static_cast<std::size_t>(master)];
    const bool is_rotation = all[i + 1] != 0;
    (is_rotation ? at.rotation : at.displacement)
        .emplace_back(Vector3d(all[i + 2], all[i + 3], all[i + 4]), all[i + 5]);
    double& scale = is_rotation ? at.rotation_scale : at.displacement_scale;
    scale = std::max(scale, all[i + 6]);
  }
}

}  // namespace plastron::assembly
