#include <plastron/assembly/handed_supports.hpp>

#include <plastron/algebra/vector.hpp>

#include <algorithm>

namespace plastron::assembly {

namespace {

constexpr std::size_t handed_size = 7;

}  // namespace

void HandedSupports::add(std::int64_t to, bool is_rotation, const std::vector<std::pair<Vector3d, double>>& rows,
                         double scale) {
  for (const auto& [d, value] : rows)
    packed_.insert(packed_.end(), {static_cast<double>(to), is_rotation ? 1.0 : 0.0, d[0], d[1], d[2], value, scale});
}

void HandedSupports::deliver(const algebra::Layout& layout, std::vector<NodeSupport>& supports) const {
  const auto all = algebra::gather_over_ranks(packed_, layout.comm);
  for (std::size_t i = 0; i < all.size(); i += handed_size) {
    const auto node = static_cast<std::int64_t>(all[i]) - layout.first;
    if (node < 0 || node >= layout.owned) continue;
    NodeSupport& at = supports[static_cast<std::size_t>(node)];
    const bool is_rotation = all[i + 1] != 0;
    (is_rotation ? at.rotation : at.displacement)
        .emplace_back(Vector3d(all[i + 2], all[i + 3], all[i + 4]), all[i + 5]);
    double& scale = is_rotation ? at.rotation_scale : at.displacement_scale;
    scale = std::max(scale, all[i + 6]);
  }
}

}  // namespace plastron::assembly
