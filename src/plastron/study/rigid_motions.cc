#include <plastron/study/rigid_motions.hpp>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include <algorithm>

namespace plastron::study {

namespace {

using Eigen::Matrix;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Matrix6 = Matrix<double, 6, 6>;
using Vector6 = Matrix<double, 6, 1>;

/// Nodal values of the six motions at a node, a column each: translations, rotations about `centre` scaled by 1 / size,
/// so that all move the shell by about one unit. Rotations r count times `size`, to weigh like displacements.
Matrix6 motions_at(const assembly::NodalPoint& p, const Vector3d& centre, double size) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>().setIdentity();
  for (int k = 0; k < 3; ++k) {
    const Vector3d w = Vector3d::Unit(k) / size;
    m.block<3, 1>(0, 3 + k) = w.cross(p.phi - centre);
    m.block<3, 1>(3, 3 + k) = w.cross(p.a3) * size;
  }
  return m;
}

/// Orthonormal basis of the kernel of a positive semidefinite matrix.
MatrixXd kernel(const MatrixXd& gram) {
  if (gram.cols() == 0) return MatrixXd(0, 0);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
  const double threshold = 1e-10 * std::max(1.0, eigen.eigenvalues().maxCoeff());
  const auto dimension = (eigen.eigenvalues().array() < threshold).count();
  return eigen.eigenvectors().leftCols(dimension);
}

std::string vector_text(Vector3d v) {
  for (double& c : v)
    if (std::abs(c) < 5e-4) c = 0;
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", v[0], v[1], v[2]);
}

std::string describe(const Vector6& motion, const Vector3d& centre) {
  Vector3d translation = motion.head<3>(), rotation = motion.tail<3>();
  constexpr double negligible = 1e-3;
  if (rotation.norm() < negligible * motion.norm()) return "translation along " + vector_text(translation.normalized());
  if (translation.norm() < negligible * motion.norm())
    return fmt::format("rotation about the axis {} through {}", vector_text(rotation.normalized()),
                       vector_text(centre));
  return fmt::format("rotation about the axis {} through {} with the translation {} for each unit of it",
                     vector_text(rotation.normalized()), vector_text(centre),
                     vector_text(translation / rotation.norm()));
}

/// Columns of `basis` put in reduced echelon form, so that pure translations and rotations show as such.
MatrixXd readable(MatrixXd basis) {
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
  return rows.transpose();
}

}  // namespace

FreeMotions free_rigid_motions(const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates) {
  Vector3d centre = Vector3d::Zero();
  for (const auto& p : points) centre += p.phi / static_cast<double>(points.size());
  double size = 0;
  for (const auto& p : points) size = std::max(size, (p.phi - centre).norm());

  Matrix6 by_supports = Matrix6::Zero(), by_gap = Matrix6::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Matrix6 motions = motions_at(points[i], centre, size);
    for (int k = 0; k < coordinates.width; ++k) {
      if (!coordinates.is_prescribed(i, k)) continue;
      const Vector6 row = motions.transpose() * coordinates.basis[i].col(k);
      by_supports += row * row.transpose();
    }
    if (coordinates.gaps.empty()) continue;
    Vector6 gap;
    gap << coordinates.gaps[i].normal, coordinates.gaps[i].z / size * coordinates.gaps[i].normal;
    const Vector6 row = motions.transpose() * gap;
    by_gap += row * row.transpose() / static_cast<double>(points.size());
  }

  const MatrixXd free = kernel(by_supports);
  FreeMotions result;
  if (free.cols() == 0) return result;
  const MatrixXd unheld = free * kernel(free.transpose() * by_gap * free);
  const MatrixXd held = free * kernel(free.transpose() * (unheld * unheld.transpose()) * free);
  const MatrixXd unheld_readable = readable(unheld), held_readable = readable(held);
  for (Eigen::Index k = 0; k < unheld.cols(); ++k) result.unheld.push_back(describe(unheld_readable.col(k), centre));
  for (Eigen::Index k = 0; k < held.cols(); ++k)
    result.held_by_obstacle.push_back(describe(held_readable.col(k), centre));
  return result;
}

}  // namespace plastron::study
