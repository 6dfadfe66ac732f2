#include <plastron/contact/scaled_unknowns.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::contact {
namespace {

using algebra::Vector;

Vector root_of_diagonal(const BoxProblem& problem) {
  Vector root = positive_diagonal(problem);
  for (double& d : root.owned()) d = std::sqrt(d);
  return root;
}

/// Returns b - A p where nothing is prescribed.
Vector first_residual(const BoxProblem& problem) {
  Vector p(problem.load.layout(), problem.load.block()), r = p;
  const auto lower = problem.lower.owned(), upper = problem.upper.owned();
  for (std::size_t i = 0; i < lower.size(); ++i)
    if (lower[i] == upper[i]) p.owned()[i] = lower[i];
  p.update_ghosts();
  problem.apply(p, r);
  for (std::size_t i = 0; i < lower.size(); ++i)
    r.owned()[i] = lower[i] == upper[i] ? 0 : problem.load.owned()[i] - r.owned()[i];
  return r;
}

}  // namespace

Vector positive_diagonal(const BoxProblem& problem) {
  Vector diagonal = problem.matrix.diagonal();
  double largest = 0;
  for (const double d : diagonal.owned()) largest = std::max(largest, d);
  largest = algebra::max_over_ranks(largest, problem.load.layout()->comm);
  for (double& d : diagonal.owned())
    if (!(d > 0)) d = largest > 0 ? largest : 1;
  return diagonal;
}

ScaledUnknowns::ScaledUnknowns(const BoxProblem& problem) : problem_(problem), root_(root_of_diagonal(problem)) {
  const double size = algebra::norm(times(-1, 1, first_residual(problem)));
  if (size > 0 && std::isfinite(size)) size_ = size;
  z_ = force_ = Vector(root_.layout(), root_.block());
  load_ = forces(problem.load);
  lower_ = times(1, 1 / size_, problem.lower);
  upper_ = times(1, 1 / size_, problem.upper);
}

/// Computes factor D^{power/2} v.
void ScaledUnknowns::times(double power, double factor, const Vector& v, Vector& result) const {
  for (std::size_t i = 0; i < v.owned().size(); ++i)
    result.owned()[i] = factor * (power > 0 ? v.owned()[i] * root_.owned()[i] : v.owned()[i] / root_.owned()[i]);
  result.update_ghosts();
}

Vector ScaledUnknowns::times(double power, double factor, const Vector& v) const {
  Vector result(v.layout(), v.block());
  times(power, factor, v, result);
  return result;
}

Vector ScaledUnknowns::unknowns(const Vector& z) const { return times(1, 1 / size_, z); }
Vector ScaledUnknowns::forces(const Vector& r) const { return times(-1, 1 / size_, r); }
Vector ScaledUnknowns::original_forces(const Vector& r) const { return times(1, size_, r); }
void ScaledUnknowns::unknowns(const Vector& z, Vector& x) const { times(1, 1 / size_, z, x); }
void ScaledUnknowns::original_forces(const Vector& r, Vector& force) const { times(1, size_, r, force); }

Vector ScaledUnknowns::original(const Vector& x) const {
  Vector z = times(-1, size_, x);
  for (std::size_t i = 0; i < z.owned().size(); ++i) {
    if (x.owned()[i] <= lower_.owned()[i]) z.owned()[i] = problem_.lower.owned()[i];
    if (x.owned()[i] >= upper_.owned()[i]) z.owned()[i] = problem_.upper.owned()[i];
  }
  z.update_ghosts();
  return z;
}

void ScaledUnknowns::apply(const Vector& x, Vector& y) const {
  times(-1, 1, x, z_);
  problem_.apply(z_, force_);
  times(-1, 1, force_, y);
}

}  // namespace plastron::contact
