#include <research/spectra/spectra.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace plastron::spectra {

namespace {

using algebra::Vector;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A stiffness below this part of the largest stiffness, or of E e^3, is rounding.
constexpr double negligible = 1e-14;

/// The smallest E e^3 of a node: what bending stiffness is made of.
double bending_scale(const assembly::DiscreteShell& discrete) {
  double least = std::numeric_limits<double>::infinity();
  for (const assembly::NodalPoint& p : discrete.points)
    least = std::min(least, p.young * p.thickness * p.thickness * p.thickness);
  return algebra::min_over_ranks(least, discrete.space().layout->comm);
}

/// The shift must be positive, for a(., .) may have a kernel, and should be smaller than what is looked for.
std::vector<Vector> softest_space(const assembly::DiscreteShell& discrete, const algebra::Matrix& X, int count) {
  const algebra::Matrix A = assembly::stiffness_matrix(discrete);
  const auto fixed = discrete.coordinates.prescribed();
  const double scale = bending_scale(discrete);
  // One alone is wanted for its value, whose error is the square of the vector's.
  const double tolerance = count == 1 ? 1e-5 : 1e-8;
  for (double shift = 1e-3 * scale;; shift *= 1e-3) {
    auto pairs = algebra::smallest_eigenpairs(A, X, fixed, shift,
                                              {.count = count, .tolerance = tolerance, .max_restarts = 1000});
    if (!pairs.converged)
      throw std::runtime_error("the softest motions were not found: the eigenvalues did not converge");
    if (pairs.values.empty() || pairs.values.back() > shift || shift < 1e-8 * scale) return std::move(pairs.vectors);
  }
}

MatrixXd products(const std::vector<Vector>& left, const std::vector<Vector>& right) {
  MatrixXd m(static_cast<Eigen::Index>(left.size()), static_cast<Eigen::Index>(right.size()));
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      m(i, j) = algebra::dot(left[static_cast<std::size_t>(i)], right[static_cast<std::size_t>(j)]);
  return m;
}

std::vector<Vector> times(const algebra::Matrix& X, const std::vector<Vector>& vectors) {
  std::vector<Vector> result;
  for (const Vector& v : vectors) X.multiply(v, result.emplace_back(v));
  return result;
}

std::vector<Vector> cartesian(const assembly::DiscreteShell& discrete, const std::vector<Vector>& space) {
  std::vector<Vector> result;
  for (const Vector& z : space) {
    Vector y(z.layout(), 6);
    discrete.coordinates.to_cartesian(z, y);
    result.push_back(std::move(y));
  }
  return result;
}

std::vector<Vector> energy_forces(const assembly::DiscreteShell& discrete, const std::vector<Vector>& ys) {
  std::vector<Vector> result;
  for (const Vector& y : ys) discrete.apply(y, result.emplace_back(y.layout(), 6));
  return result;
}

Vector3d centre_of(const assembly::DiscreteShell& discrete) {
  Vector3d sum = Vector3d::Zero();
  const auto& layout = *discrete.space().layout;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.owned); ++i) sum += discrete.points[i].phi;
  for (double& component : sum) component = algebra::sum_over_ranks(component, layout.comm);
  return sum / static_cast<double>(layout.global_size);
}

/// Three translations, then three rotations about the middle, in nodal coordinates, which are orthonormal.
std::vector<Vector> rigid_motions(const assembly::DiscreteShell& discrete) {
  const Vector3d centre = centre_of(discrete);
  std::vector<Vector> motions;
  for (int k = 0; k < 6; ++k) {
    const Vector3d c = k < 3 ? Vector3d(Vector3d::Unit(k)) : Vector3d::Zero();
    const Vector3d w = k < 3 ? Vector3d::Zero() : Vector3d(Vector3d::Unit(k - 3));
    Vector y(discrete.space().layout, 6);
    for (std::size_t i = 0; i < discrete.points.size(); ++i) {
      const assembly::NodalPoint& p = discrete.points[i];
      Eigen::Map<assembly::Vector6>(y.at(i).data()) << c + w.cross(p.phi - centre), w.cross(p.a3);
    }
    Vector& z = motions.emplace_back(discrete.space().layout, discrete.coordinates.width);
    discrete.coordinates.add_transposed(y, z);
  }
  return motions;
}

/// Coordinates of `space` along an orthonormal basis of the rigid motions, translations first: 6 rows, a column per vector.
MatrixXd along_rigid_motions(const assembly::DiscreteShell& discrete, const algebra::Matrix& X,
                             const std::vector<Vector>& space) {
  const auto motions = rigid_motions(discrete);
  const auto X_motions = times(X, motions);
  const Eigen::LLT<MatrixXd> gram(products(motions, X_motions));  // L of Gram-Schmidt in this order
  return gram.matrixL().solve(products(X_motions, space));
}

/// int of f(r, a_3) over the mid-surface, by the nodal quadrature.
template <class Function>
double integral(const assembly::DiscreteShell& discrete, const Vector& y, const Function& f) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const Vector3d r = assembly::node_values(y, i).tail<3>();
    sum += discrete.points[i].weight * f(r, discrete.points[i].a3);
  }
  return algebra::sum_over_ranks(sum, discrete.space().layout->comm);
}

double constant_normal_rotation(const assembly::DiscreteShell& discrete, const Vector& y) {
  const double area = integral(discrete, y, [](const Vector3d&, const Vector3d&) { return 1.0; });
  const double normal_rotation = integral(discrete, y, [](const Vector3d& r, const Vector3d& a3) { return r.dot(a3); });
  const double all = integral(discrete, y, [](const Vector3d& r, const Vector3d&) { return r.squaredNorm(); });
  return all > 0 ? normal_rotation * normal_rotation / (area * all) : 0;
}

/// Turns the first `count` columns so that translations come first, then rotations.
void sort_by_kind(const MatrixXd& rigid, Eigen::Index count, MatrixXd& coefficients) {
  if (count < 2) return;
  const MatrixXd of_modes = rigid * coefficients.leftCols(count);
  const MatrixXd rank = 2 * of_modes.topRows(3).transpose() * of_modes.topRows(3) +
                        of_modes.bottomRows(3).transpose() * of_modes.bottomRows(3);
  const auto eigen = geometry::symmetric_eigen(MatrixXd(-rank));
  coefficients.leftCols(count) = (coefficients.leftCols(count) * eigen.vectors).eval();
}

}  // namespace

std::string_view to_string(ModeKind kind) {
  switch (kind) {
    case ModeKind::translation:
      return "translation";
    case ModeKind::rotation:
      return "rotation";
    case ModeKind::normal_rotation:
      return "normal_rotation";
    case ModeKind::deformation:
      break;
  }
  return "deformation";
}

ModeKind Mode::kind() const {
  if (translation + rotation > 0.5) return translation > rotation ? ModeKind::translation : ModeKind::rotation;
  return normal_rotation > 0.1 ? ModeKind::normal_rotation : ModeKind::deformation;
}

std::vector<Mode> softest_modes(const assembly::DiscreteShell& discrete, int count, double length) {
  PLASTRON_ASSERT(discrete.obstacles.empty(), "the coordinates of a node that can touch are not orthonormal");
  const algebra::Matrix X = h1_matrix(discrete.shell, discrete.coordinates, length);
  const auto space = softest_space(discrete, X, count);
  if (space.empty()) return {};
  const auto ys = cartesian(discrete, space);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ritz(products(ys, energy_forces(discrete, ys)),
                                                                products(space, times(X, space)));
  VectorXd stiffness = ritz.eigenvalues();
  MatrixXd coefficients = ritz.eigenvectors();
  Eigen::Index free = 0;
  for (const double threshold = negligible * std::max(stiffness.maxCoeff(), bending_scale(discrete));
       free < stiffness.size(); ++free)
    if (stiffness[free] > threshold) break;
  stiffness.head(free).setZero();
  const MatrixXd rigid = along_rigid_motions(discrete, X, space);
  sort_by_kind(rigid, free, coefficients);

  std::vector<Mode> modes;
  for (Eigen::Index k = 0; k < stiffness.size(); ++k) {
    Vector y(ys[0].layout(), 6);
    for (std::size_t i = 0; i < ys.size(); ++i) algebra::axpy(coefficients(static_cast<Eigen::Index>(i), k), ys[i], y);
    const VectorXd along = rigid * coefficients.col(k);
    modes.push_back({.stiffness = stiffness[k],
                     .translation = along.head<3>().squaredNorm(),
                     .rotation = along.tail<3>().squaredNorm(),
                     .normal_rotation = constant_normal_rotation(discrete, y)});
  }
  return modes;
}

}  // namespace plastron::spectra
