#include <plastron/assembly/constrained_supports.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/constraints/map.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <utility>

namespace plastron::assembly {

namespace {

using SupportRows = std::vector<std::pair<Vector3d, double>>;

/// Rows on their way to other nodes.
class MovedRows {
 public:
  void add(algebra::GlobalIndex to, bool is_rotation, const SupportRows& rows, double scale) {
    for (const auto& [direction, value] : rows) rows_.push_back({to, is_rotation, direction, value, scale});
  }

  /// Adds the rows of all ranks to the supports of the owned nodes (collective).
  void deliver(const algebra::Layout& layout, std::vector<NodeSupport>& supports) const {
    for (const MovedRow& row : algebra::gathered(rows_, layout.comm)) {
      if (!layout.owns(row.to)) continue;
      NodeSupport& at = supports[static_cast<std::size_t>(row.to - layout.first)];
      (row.is_rotation ? at.rotation : at.displacement).emplace_back(row.direction, row.value);
      double& scale = row.is_rotation ? at.rotation_scale : at.displacement_scale;
      scale = std::max(scale, row.scale);
    }
  }

 private:
  struct MovedRow {
    algebra::GlobalIndex to;
    bool is_rotation;
    Vector3d direction;
    double value, scale;
  };
  std::vector<MovedRow> rows_{};
};

/// Two rotations at a kinked node: its own one about the direction across the edge, and the one about the edge, which
/// it shares with the other node.
struct KinkFrame {
  KinkFrame(const constraints::Row& row, const constraints::Term& turning, const Vector3d& a3) {
    const Eigen::Matrix3d own = row.own().bottomRightCorner<3, 3>() - a3 * a3.transpose();
    Eigen::Index largest = 0;
    own.colwise().norm().maxCoeff(&largest);
    along = own.col(largest).normalized();
    across = a3.cross(along);
    of_other = turning.block->bottomRightCorner<3, 3>().transpose() * across;
  }
  Vector3d along, across, of_other;
};

[[noreturn]] void refuse_rotation(const NodalPoint& point, const char* why) {
  throw SupportError(fmt::format(
      "a support holds a rotation at x = {:g}, y = {:g}, where shells are joined at an angle, {}; hold all of "
      "r there, or the component along the edge or across it",
      point.x[0], point.x[1], why));
}

/// Returns the terms of the other nodes with which a kinked node turns; none if all its kinks are hinges.
std::vector<constraints::Term> turning_terms(const constraints::Row& row) {
  std::vector<constraints::Term> turning;
  for (const constraints::Term& term : row.terms)
    if (term.node != row.node && !term.block->bottomRightCorner<3, 3>().isZero(0)) turning.push_back(term);
  return turning;
}

/// Splits the rows on r of a kinked node: keeps those on its own rotation, returns rows on the rotation of the other node.
SupportRows split_rotation(const constraints::Row& row, const constraints::Term& turning, const NodalPoint& point,
                           NodeSupport& support) {
  constexpr double parallel_part = 1e-6;
  const KinkFrame frame(row, turning, point.a3);
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
  const Eigen::Vector2d prescribed = solver.solve(values);
  if ((rows * prescribed - values).norm() > 1e-9 * (support.rotation_scale + values.norm()))
    throw SupportError(fmt::format("supports contradict each other at x = {:g}, y = {:g}", point.x[0], point.x[1]));
  const bool says_along = rows.col(0).norm() > parallel_part, says_across = rows.col(1).norm() > parallel_part;
  if (says_along && says_across && solver.rank() < 2)
    refuse_rotation(point, "in a direction between its edge and across");
  support.rotation.clear();
  if (says_along) support.rotation.emplace_back(frame.along, prescribed[0]);
  if (says_across) return {{frame.of_other, prescribed[1]}};
  return {};
}

/// Moves rows of nodes that equal another node.
void move_to_equal_nodes(const fem::Space& space, std::vector<NodeSupport>& supports) {
  const algebra::Layout& layout = *space.layout;
  MovedRows moved;
  for (const constraints::Row& row : space.continuity.rows()) {
    if (row.node >= layout.owned) continue;
    NodeSupport& own = supports[static_cast<std::size_t>(row.node)];
    if (row.terms.size() == 1) {
      const auto other = layout.global(row.terms[0].node);
      moved.add(other, false, own.displacement, own.displacement_scale);
      moved.add(other, true, own.rotation, own.rotation_scale);
    }
    own = {};
  }
  moved.deliver(layout, supports);
}

void move_across_kinks(const fem::Space& space, const std::vector<NodalPoint>& points,
                       std::vector<NodeSupport>& supports) {
  const algebra::Layout& layout = *space.layout;
  MovedRows moved;
  algebra::in_agreement<SupportError>(layout.comm, [&] {
    for (const constraints::Row& kink : space.kinks.rows()) {
      if (kink.node >= layout.owned) continue;
      const auto node = static_cast<std::size_t>(kink.node);
      NodeSupport& own = supports[node];
      moved.add(layout.global(kink.terms[0].node), false, own.displacement, own.displacement_scale);
      own.displacement.clear();
      const constraints::Row& row = *space.constraints.find(node);
      const auto turning = turning_terms(row);
      if (own.rotation.empty() || turning.empty()) continue;
      if (turning.size() > 1) refuse_rotation(points[node], "several of them");
      moved.add(layout.global(turning[0].node), true, split_rotation(row, turning[0], points[node], own),
                own.rotation_scale);
    }
  });
  moved.deliver(layout, supports);
}

}  // namespace

void move_to_free_nodes(const fem::Space& space, const std::vector<NodalPoint>& points,
                        std::vector<NodeSupport>& supports) {
  if (!space.continuity.is_identity()) move_to_equal_nodes(space, supports);
  if (!space.kinks.is_identity()) move_across_kinks(space, points, supports);
}

}  // namespace plastron::assembly
