#include <plastron/estimation/error_profiles.hpp>

#include <plastron/fem/basis.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::estimation {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Orthonormal polynomials of degrees 0 to n - 1 at the n Gauss points in [0, 1], times the roots of the weights. The
/// result is an orthogonal matrix with a row per degree.
MatrixXd weighed_legendre(int n) {
  const fem::Rule rule = fem::gauss(n);
  MatrixXd p(n, n);
  for (int a = 0; a < n; ++a) {
    const double x = 2 * rule.points[static_cast<std::size_t>(a)] - 1;
    const double root = std::sqrt(rule.weights[static_cast<std::size_t>(a)]);
    double before = 0, now = 1;
    for (int i = 0; i < n; ++i) {
      p(i, a) = root * std::sqrt(2 * i + 1) * now;
      const double next = ((2 * i + 1) * x * now - i * before) / (i + 1);
      before = now;
      now = next;
    }
  }
  return p;
}

class Profiler {
 public:
  explicit Profiler(int points) : legendre_(weighed_legendre(points)), along_first_(points, points) {
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) along_first_(i, j) = i + j == 0 ? 0.5 : double{1} * i * i / (i * i + j * j);
  }

  /// Computes a profile from strains and stresses at the points; stresses contain the points' area. The products give
  /// the energy, the strains its sign.
  ErrorProfile operator()(const assembly::CellStrain& strains, const assembly::CellStrain& stresses) const {
    const Index n = legendre_.rows();
    MatrixXd energy = MatrixXd::Zero(n, n);
    double first = 0;
    for (Index k = 0; k < strains.cols(); ++k) {
      // indices: xi_1, xi_2.
      MatrixXd root(n, n);
      for (Index q = 0; q < n * n; ++q) {
        const double product = std::max(stresses(q, k) * strains(q, k), 0.0);
        energy(q % n, q / n) += product;
        root(q % n, q / n) = std::copysign(std::sqrt(product), strains(q, k));
      }
      first += (legendre_ * root * legendre_.transpose()).cwiseAbs2().cwiseProduct(along_first_).sum();
    }
    const double whole = energy.sum();
    if (!(whole > 0))
      return {std::vector<double>(static_cast<std::size_t>(n), 0), std::vector<double>(static_cast<std::size_t>(n), 0)};
    const double part = std::clamp(first / whole, 0.0, 1.0);
    const Eigen::VectorXd columns = part / whole * energy.rowwise().sum(),
                          rows = (1 - part) / whole * energy.colwise().sum().transpose();
    return {std::vector<double>(columns.begin(), columns.end()), std::vector<double>(rows.begin(), rows.end())};
  }

 private:
  MatrixXd legendre_, along_first_;
};

}  // namespace

std::vector<ErrorProfile> error_profiles(const assembly::ShellOperator& shell,
                                         const std::vector<StrainErrors>& errors) {
  if (shell.space().shape() != fem::Shape::quadrilateral) return {};
  const Profiler profile(shell.space().degree + 1);
  std::vector<ErrorProfile> profiles;
  profiles.reserve(errors.size());
  for (std::size_t c = 0; c < errors.size(); ++c)
    profiles.push_back(profile(errors[c].error, shell.weighted_stresses(c, errors[c].error)));
  return profiles;
}

}  // namespace plastron::estimation
