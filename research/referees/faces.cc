#include <plastron/algebra/pseudo_random.hpp>
#include <research/referees/faces.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::referees {
namespace {

using algebra::Vector;

Vector root_of_diagonal(const contact::BoxProblem& problem) {
  Vector root = positive_diagonal(problem);
  for (double& d : root.owned()) d = std::sqrt(d);
  return root;
}

/// Returns b - A p where nothing is prescribed.
Vector first_residual(const contact::BoxProblem& problem) {
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

Vector positive_diagonal(const contact::BoxProblem& problem) {
  Vector diagonal = problem.matrix.diagonal();
  double largest = 0;
  for (const double d : diagonal.owned()) largest = std::max(largest, d);
  largest = algebra::max_over_ranks(largest, problem.load.layout()->comm);
  for (double& d : diagonal.owned())
    if (!(d > 0)) d = largest > 0 ? largest : 1;
  return diagonal;
}

ScaledUnknowns::ScaledUnknowns(const contact::BoxProblem& problem)
    : problem_(problem), root_(root_of_diagonal(problem)) {
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

void split_gradient(const Vector& lower, const Vector& upper, const Vector& x, const Vector& gradient, double alpha,
                    SplitGradient& split) {
  split.active.assign(x.owned().size(), 0);
  for (Vector* part : {&split.free, &split.chopped}) {
    if (!part->layout()) *part = Vector(x.layout(), x.block());
    part->fill(0);
  }
  split.reduced_product = 0;
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double g = gradient.owned()[i], z = x.owned()[i];
    const bool at_lower = z <= lower.owned()[i], at_upper = z >= upper.owned()[i];
    split.active[i] = at_lower || at_upper;
    if (!split.active[i]) {
      split.free.owned()[i] = g;
      const double room = (g > 0 ? z - lower.owned()[i] : upper.owned()[i] - z) / alpha;
      split.reduced_product += std::min(room, std::abs(g)) * std::abs(g);
    } else if (at_lower != at_upper) {
      split.chopped.owned()[i] = at_lower ? std::min(g, 0.0) : std::max(g, 0.0);
    }
  }
  split.reduced_product = algebra::sum_over_ranks(split.reduced_product, x.layout()->comm);
  split.chopped_square = algebra::dot(split.chopped, split.chopped);
}

double largest_eigenvalue(const algebra::Operator& apply, const Vector& like) {
  constexpr int steps = 20;
  Vector v(like.layout(), like.block()), Av = v;
  algebra::fill_with_pseudo_random_values(v);
  double value = 0;
  for (int step = 0; step < steps; ++step) {
    const double size = algebra::norm(v);
    if (!(size > 0)) break;
    for (double& entry : v.owned()) entry /= size;
    v.update_ghosts();
    apply(v, Av);
    value = algebra::dot(v, Av);
    v = Av;
  }
  return value > 0 ? value : 1;
}

bool FacePreconditioner::fix(const contact::BoxProblem& problem, const contact::ActiveSet& set,
                             bool detect_free_motions) {
  fixed_ = contact::fixed_by(set);
  return preconditioner_.fix(fixed_, problem.shift) &&
         !(detect_free_motions && preconditioner_.softest_motion(problem.apply, fixed_, diagonal_).is_free());
}

void FacePreconditioner::apply(const Vector& r, Vector& z) const {
  on_free_ = r;
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i]) on_free_.owned()[i] = 0;
  preconditioner_.apply(on_free_, z);
  for (std::size_t i = 0; i < fixed_.size(); ++i)
    if (fixed_[i]) z.owned()[i] = r.owned()[i] / diagonal_.owned()[i];
}

}  // namespace plastron::referees
