#include <plastron/topology/height_fit.hpp>

#include <Eigen/QR>

#include <array>

namespace plastron::topology {

namespace {

using Eigen::Index;

constexpr double least_pivot = 1e-5;  // of a fit that its points determine, over the largest one

/// Legendre polynomials up to a degree and their derivatives at x.
struct Legendre {
  Eigen::VectorXd value, d;

  Legendre(int degree, double x) : value(degree + 1), d(degree + 1) {
    value[0] = 1;
    d[0] = 0;
    if (degree == 0) return;
    value[1] = x;
    d[1] = 1;
    for (Index k = 1; k < degree; ++k) {
      const auto n = static_cast<double>(k);
      value[k + 1] = ((2 * n + 1) * x * value[k] - n * value[k - 1]) / (n + 1);
      d[k + 1] = d[k - 1] + (2 * n + 1) * value[k];
    }
  }
};

/// Rows of all products P_i(s) P_j(t) with i + j <= degree: values, derivatives by s and by t.
std::array<Eigen::VectorXd, 3> products(int degree, double s, double t) {
  const Legendre first(degree, s), second(degree, t);
  const Index count = HeightFit::coefficient_count(degree);
  std::array<Eigen::VectorXd, 3> rows{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  Index k = 0;
  for (Index i = 0; i <= degree; ++i)
    for (Index j = 0; i + j <= degree; ++j, ++k) {
      rows[0][k] = first.value[i] * second.value[j];
      rows[1][k] = first.d[i] * second.value[j];
      rows[2][k] = first.value[i] * second.d[j];
    }
  return rows;
}

}  // namespace

HeightFit::HeightFit(std::span<const Eigen::Vector3d> points, int degree) : degree_(degree) {
  Eigen::MatrixXd rows(static_cast<Index>(points.size()), coefficient_count(degree));
  Eigen::VectorXd heights(static_cast<Index>(points.size()));
  Index row = 0;
  for (const Eigen::Vector3d& point : points) {
    rows.row(row) = products(degree, point[0], point[1])[0].transpose();
    heights[row++] = point[2];
  }
  auto decomposition = rows.colPivHouseholderQr();
  decomposition.setThreshold(least_pivot);
  is_determined_ = decomposition.rank() == rows.cols();
  coefficients_ = decomposition.solve(heights);
}

double HeightFit::height(double s, double t) const { return products(degree_, s, t)[0].dot(coefficients_); }

Eigen::Vector3d HeightFit::normal(double s, double t) const {
  const auto rows = products(degree_, s, t);
  return {-rows[1].dot(coefficients_), -rows[2].dot(coefficients_), 1};
}

}  // namespace plastron::topology
