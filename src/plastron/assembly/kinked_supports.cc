#include <plastron/assembly/kinked_supports.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/assembly/handed_supports.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

namespace plastron::assembly {

namespace {

using Row = std::pair<Vector3d, double>;

/// Two rotations at a kinked node: its own one about the direction across the edge, and the one about the edge, which
/// it shares with the other node.
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

/// Splits the rows on r of a kinked node: keeps those on its own rotation, returns rows on the other node's rotation.
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

}  // namespace

void hand_across_kinks(const fem::Space& space, const std::vector<NodalPoint>& points,
                       std::vector<NodeSupport>& supports) {
  if (!space.carried) return;
  const algebra::Layout& layout = *space.layout;
  HandedSupports handed;
  algebra::in_agreement<SupportError>(layout.comm, [&] {
    for (const fem::CarriedNode& node : space.carried->nodes) {
      if (node.node >= layout.owned || !fem::is_kinked(*space.carried, node)) continue;
      NodeSupport& own = supports[static_cast<std::size_t>(node.node)];
      const auto other = layout.global(node.carriers[0].first);
      handed.add_displacement(other, own.displacement, own.displacement_scale);
      handed.add_rotation(other, split_rotation(node, points[static_cast<std::size_t>(node.node)], own),
                          own.rotation_scale);
      own.displacement.clear();
    }
  });
  handed.deliver(layout, supports);
}

}  // namespace plastron::assembly
