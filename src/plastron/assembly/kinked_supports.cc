#include <plastron/assembly/kinked_supports.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/kinks.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>

namespace plastron::assembly {

namespace {

using Row = std::pair<Vector3d, double>;

/// The pair of rotations at a kinked node: its own, about what is across the edge, and that with the other node.
struct KinkFrame {
  KinkFrame(const fem::CarriedNode& node, const Vector3d& a3) {
    const Eigen::Matrix3d own = node.own.bottomRightCorner<3, 3>() - a3 * a3.transpose();
    Eigen::Index largest = 0;
    own.colwise().norm().maxCoeff(&largest);
    along = own.col(largest).normalized();
    across = a3.cross(along);
    of_other = node.carriers[0].second.bottomRightCorner<3, 3>().transpose() * across;
  }
  Vector3d along, across, of_other;
};

[[noreturn]] void refuse_rotation(const NodalPoint& point, const char* why) {
  throw SupportError(fmt::format(
      "a support holds a rotation at x = {:g}, y = {:g}, where shells are joined at an angle, {}; hold all of "
      "r there, or the component along the edge or across it",
      point.x[0], point.x[1], why));
}

/// What rows on r of a kinked node say of its own rotation, kept, and of the other's, returned.
std::vector<Row> split_rotation(const fem::CarriedNode& node, const NodalPoint& point, NodeSupport& support) {
  constexpr double parallel_part = 1e-6;
  if (support.rotation.empty()) return {};
  if (node.carriers.size() > 1) refuse_rotation(point, "several of them");
  const KinkFrame frame(node, point.a3);
  Eigen::MatrixX2d rows(static_cast<Eigen::Index>(support.rotation.size()), 2);
  Eigen::VectorXd values(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto& [direction, value] = support.rotation[static_cast<std::size_t>(i)];
    rows.row(i) << direction.dot(frame.along), direction.dot(frame.across);
    values[i] = value;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixX2d> solver(rows.rows(), 2);
  solver.setThreshold(parallel_part);
  solver.compute(rows);
  const Eigen::Vector2d held = solver.solve(values);
  if ((rows * held - values).norm() > 1e-9 * (support.rotation_scale + values.norm()))
    throw SupportError(fmt::format("supports contradict each other at x = {:g}, y = {:g}", point.x[0], point.x[1]));
  const bool says_along = rows.col(0).norm() > parallel_part, says_across = rows.col(1).norm() > parallel_part;
  if (says_along && says_across && solver.rank() < 2)
    refuse_rotation(point, "in a direction between its edge and across");
  support.rotation.clear();
  if (says_along) support.rotation.emplace_back(frame.along, held[0]);
  if (says_across) return {{frame.of_other, held[1]}};
  return {};
}

/// master, 0 for u and 1 for r, direction, value, scale.
void add_handed(std::int64_t master, bool is_rotation, const std::vector<Row>& rows, double scale,
                std::vector<double>& out) {
  for (const auto& [d, value] : rows)
    out.insert(out.end(), {static_cast<double>(master), is_rotation ? 1.0 : 0.0, d[0], d[1], d[2], value, scale});
}

}  // namespace

void hand_across_kinks(const fem::Space& space, const std::vector<NodalPoint>& points,
                       std::vector<NodeSupport>& supports) {
  if (!space.carried) return;
  constexpr std::size_t handed_row_size = 7;
  const algebra::Layout& layout = *space.layout;
  std::vector<double> handed;
  algebra::in_agreement<SupportError>(layout.comm, [&] {
    for (const fem::CarriedNode& node : space.carried->nodes) {
      if (node.node >= layout.owned || !fem::is_kinked(*space.carried, node)) continue;
      NodeSupport& own = supports[static_cast<std::size_t>(node.node)];
      const auto other = layout.global(node.carriers[0].first);
      add_handed(other, false, own.displacement, own.displacement_scale, handed);
      add_handed(other, true, split_rotation(node, points[static_cast<std::size_t>(node.node)], own),
                 own.rotation_scale, handed);
      own.displacement.clear();
    }
  });
  const auto all = algebra::gather_over_ranks(handed, layout.comm);
  for (std::size_t i = 0; i < all.size(); i += handed_row_size) {
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
