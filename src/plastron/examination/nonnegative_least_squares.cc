#include <plastron/examination/nonnegative_least_squares.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <vector>

namespace plastron::examination {

namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

VectorXd best_on(const MatrixXd& A, const std::vector<Index>& columns, const VectorXd& b) {
  const MatrixXd taken = A(Eigen::all, columns);
  return taken.colPivHouseholderQr().solve(b);
}

/// The active columns with their coefficients, all positive.
struct Passive {
  std::vector<Index> columns;
  VectorXd x;

  void drop_zeros() {
    std::vector<Index> kept;
    std::vector<double> values;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (x[static_cast<Index>(k)] > 0) {
        kept.push_back(columns[k]);
        values.push_back(x[static_cast<Index>(k)]);
      }
    columns = std::move(kept);
    x = Eigen::Map<VectorXd>(values.data(), static_cast<Index>(values.size()));
  }

  /// Moves x towards the best coefficients, and removes columns that become negative on the way.
  void settle(const MatrixXd& A, const VectorXd& b) {
    while (!columns.empty()) {
      const VectorXd s = best_on(A, columns, b);
      if (s.minCoeff() > 0) {
        x = s;
        return;
      }
      double step = 1;
      Index first = 0;
      for (Index k = 0; k < s.size(); ++k)
        if (s[k] <= 0 && x[k] / (x[k] - s[k]) <= step) {
          step = x[k] / (x[k] - s[k]);
          first = k;
        }
      x += step * (s - x);
      x[first] = 0;  // exactly, without a positive rounding error
      drop_zeros();
    }
  }
};

}  // namespace

VectorXd nonnegative_residual(const MatrixXd& A, const VectorXd& b) {
  Passive passive;
  VectorXd residual = b;
  if (A.cols() == 0) return residual;
  const double negligible = 1e-13 * b.norm() * A.colwise().norm().maxCoeff();
  // Each step lowers |residual|. The limit is necessary because rounding may undo a step.
  for (int step = 0; step < 100; ++step) {
    Index steepest = 0;
    if ((A.transpose() * residual).maxCoeff(&steepest) <= negligible) break;
    if (std::ranges::find(passive.columns, steepest) != passive.columns.end()) break;
    passive.columns.push_back(steepest);
    passive.x.conservativeResize(passive.x.size() + 1);
    passive.x.tail<1>()[0] = 0;
    // A new column may start at zero because its coefficient increases.
    passive.settle(A, b);
    residual = b;
    for (std::size_t k = 0; k < passive.columns.size(); ++k)
      residual -= passive.x[static_cast<Index>(k)] * A.col(passive.columns[k]);
  }
  return residual;
}

}  // namespace plastron::examination
