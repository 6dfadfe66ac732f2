#include <plastron/examination/rigid_motions.hpp>

#include <plastron/examination/checks.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/topology/disjoint_sets.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace plastron::examination {

namespace {

using Eigen::Matrix;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Matrix6 = Matrix<double, 6, 6>;

/// Orthonormal basis of the kernel of a positive semidefinite matrix.
MatrixXd kernel(const MatrixXd& gram) {
  if (gram.cols() == 0) return MatrixXd(0, 0);
  const auto eigen = geometry::symmetric_eigen(gram);
  const double threshold = 1e-10 * std::max(1.0, eigen.values.maxCoeff());
  const auto dimension = (eigen.values.array() < threshold).count();
  return eigen.vectors.leftCols(dimension);
}

}  // namespace

std::vector<ShellPart> parts_of(const fem::Space& space, const std::vector<assembly::NodalPoint>& points,
                                bool through_hinges) {
  topology::DisjointSets sets(points.size());
  const auto unite = [&](algebra::LocalIndex i, algebra::LocalIndex j) {
    sets.unite(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  };
  for (std::size_t c = 0; c < space.cells.size(); ++c)
    for (const algebra::LocalIndex node : space.nodes(c)) unite(space.nodes(c)[0], node);
  for (const constraints::Row& row : space.constraints.rows())
    for (const constraints::Term& term : row.terms)
      if (through_hinges || !term.block || !term.block->bottomRightCorner<3, 3>().isZero(0)) unite(row.node, term.node);
  for (const fem::PlacedBody& placed : space.bodies)
    for (const fem::BodyNode& member : placed.members) unite(placed.members.front().node, member.node);

  std::vector<ShellPart> parts;
  std::map<std::size_t, std::size_t> number;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [at, is_new] = number.emplace(sets.of(i), parts.size());
    if (is_new) parts.emplace_back();
    parts[at->second].nodes.push_back(i);
    parts[at->second].points.push_back(points[i]);
  }
  for (const fem::PlacedBody& placed : space.bodies)
    parts[number.at(sets.of(static_cast<std::size_t>(placed.members.front().node)))].bodies.push_back(&placed);
  return parts;
}

RigidMotions::RigidMotions(const std::vector<assembly::NodalPoint>& points) : centre_(Vector3d::Zero()), size_(0) {
  for (const auto& p : points) centre_ += p.phi / static_cast<double>(points.size());
  for (const auto& p : points) size_ = std::max(size_, (p.phi - centre_).norm());
}

Matrix6 RigidMotions::at(const assembly::NodalPoint& point) const {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>().setIdentity();
  for (int k = 0; k < 3; ++k) {
    const Vector3d w = Vector3d::Unit(k) / size_;
    m.block<3, 1>(0, 3 + k) = w.cross(point.phi - centre_);
    m.block<3, 1>(3, 3 + k) = w.cross(point.a3) * size_;
  }
  return m;
}

RigidMotion RigidMotions::gap_change(const assembly::NodalPoint& point, const obstacle::Gap& gap) const {
  RigidMotion row;
  row << gap.normal, gap.arm / size_ * gap.normal;
  return at(point).transpose() * row;
}

Matrix6 RigidMotions::fixed_by(const fem::RigidBody& body) const {
  Matrix6 gram = Matrix6::Zero();
  for (int c = 0; c < 6; ++c) {
    if (!body.fixed[static_cast<std::size_t>(c)]) continue;
    RigidMotion row = RigidMotion::Unit(c);
    // d = c + w x (reference - centre), with rotations w = (tail / size): row . d as a functional of (c, size w)
    if (c < 3) row.tail<3>() = (body.reference - centre_).cross(Vector3d::Unit(c)) / size_;
    gram += row * row.transpose();
  }
  return gram;
}

algebra::Vector RigidMotions::forces_of(const energy::Term& term, const energy::ShellOperator& shell,
                                        const ShellPart& part, int k) const {
  algebra::Vector motion(shell.space().layout, 6), forces = motion;
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    RigidMotion moved = at(part.points[i]).col(k);
    moved.tail<3>() /= size_;
    std::ranges::copy(moved, motion.at(part.nodes[i]).begin());
  }
  term.add_forces(shell, motion, forces);
  return forces;
}

Matrix6 RigidMotions::stiffness_of(const energy::Term& term, const energy::ShellOperator& shell,
                                   const ShellPart& part) const {
  Matrix6 all = Matrix6::Zero();
  for (int k = 0; k < 6; ++k) all.col(k) = work(part, forces_of(term, shell, part, k).local());
  const double largest = all.diagonal().maxCoeff();
  return largest > 0 ? Matrix6(all / largest) : all;
}

RigidMotion RigidMotions::work(const ShellPart& part, std::span<const double> forces) const {
  RigidMotion sum = RigidMotion::Zero();
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    RigidMotion force = Eigen::Map<const RigidMotion>(forces.data() + 6 * part.nodes[i]);
    force.tail<3>() /= size_;
    sum += at(part.points[i]).transpose() * force;
  }
  return sum;
}

namespace {

constexpr double negligible = 1e-3;

}  // namespace

bool RigidMotions::is_rotation(const RigidMotion& motion) {
  return motion.tail<3>().norm() >= negligible * motion.norm();
}

/// Returns a point of the axis. A translation perpendicular to the axis moves it; one along the axis gives a screw
/// motion.
Vector3d RigidMotions::on_axis(const RigidMotion& motion) const {
  const Vector3d translation = motion.head<3>(), rotation = motion.tail<3>();
  return centre_ + size_ * rotation.cross(translation) / rotation.squaredNorm();
}

Eigen::Matrix3d RigidMotions::turn(const RigidMotion& motion, double angle) {
  return Eigen::AngleAxisd(angle, motion.tail<3>().normalized()).toRotationMatrix();
}

Vector3d RigidMotions::turned(const Vector3d& place, const RigidMotion& motion, double angle) const {
  const Vector3d centre = on_axis(motion);
  return centre + turn(motion, angle) * (place - centre);
}

std::string RigidMotions::in_words(const RigidMotion& motion) const {
  const Vector3d translation = motion.head<3>(), rotation = motion.tail<3>();
  if (!is_rotation(motion)) return "translation along " + vector_text(translation.normalized());
  const Vector3d axis = rotation.normalized();
  std::string turn =
      fmt::format("rotation about the axis {} through {}", vector_text(axis), vector_text(on_axis(motion), size_));
  const double pitch = axis.dot(translation) / rotation.norm();
  if (std::abs(pitch) < negligible) return turn;
  return fmt::format("{} with the translation {:.3g} m along it for each radian", turn, pitch * size_);
}

std::vector<RigidMotion> readable(const MatrixXd& basis) {
  MatrixXd rows = basis.transpose();
  Eigen::Index next = 0;
  for (Eigen::Index column = rows.cols() - 1; column >= 0 && next < rows.rows(); --column) {
    Eigen::Index pivot = 0;
    if (rows.col(column).tail(rows.rows() - next).cwiseAbs().maxCoeff(&pivot) < 1e-8) continue;
    rows.row(next).swap(rows.row(next + pivot));
    rows.row(next) /= rows(next, column);
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      if (i != next) rows.row(i) -= rows(i, column) * rows.row(next);
    ++next;
  }
  std::vector<RigidMotion> motions;
  for (Eigen::Index k = 0; k < rows.rows(); ++k) motions.emplace_back(rows.row(k).transpose());
  return motions;
}

FreeMotions free_rigid_motions(const RigidMotions& motions, const ShellPart& part,
                               const assembly::NodalCoordinates& coordinates, const energy::ShellOperator& shell,
                               const energy::Terms& terms) {
  Matrix6 by_supports = Matrix6::Zero(), by_gap = Matrix6::Zero();
  for (const auto& term : terms)
    by_supports += static_cast<double>(part.nodes.size()) * motions.stiffness_of(*term, shell, part);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    const std::size_t node = part.nodes[i];
    const Matrix6 at_node = motions.at(part.points[i]);
    for (int k = 0; k < coordinates.width; ++k) {
      if (!coordinates.is_prescribed(node, k)) continue;
      const RigidMotion row = at_node.transpose() * coordinates.direction(node, k);
      by_supports += row * row.transpose();
    }
    for (const auto& gaps : coordinates.gaps) {
      const RigidMotion row = motions.gap_change(part.points[i], gaps[node]);
      by_gap += row * row.transpose() / static_cast<double>(part.nodes.size());
    }
  }
  for (const fem::PlacedBody* placed : part.bodies) by_supports += motions.fixed_by(placed->body);
  const MatrixXd free = kernel(by_supports);
  FreeMotions result{.unheld = MatrixXd(6, 0), .held_by_obstacle = MatrixXd(6, 0)};
  if (free.cols() == 0) return result;
  result.unheld = free * kernel(free.transpose() * by_gap * free);
  result.held_by_obstacle = free * kernel(free.transpose() * (result.unheld * result.unheld.transpose()) * free);
  return result;
}

}  // namespace plastron::examination
