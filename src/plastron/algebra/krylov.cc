#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/krylov.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::algebra {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

void set_zero_where(std::span<const char> fixed, Vector& v) {
  const auto values = v.owned();
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) values[i] = 0;
}

// The system restricted to the unknowns that are not fixed.
struct RestrictedSystem {
  const Operator& apply;
  const Operator& precondition;
  const Vector& b;
  std::span<const char> fixed;

  // Computes b - A x, including the equations of the fixed unknowns.
  void full_residual(Vector& x, Vector& r) const {
    x.update_ghosts();
    apply(x, r);
    const auto load = b.owned();
    const auto values = r.owned();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = load[i] - values[i];
  }

  // Computes z = M^{-1} r; returns sqrt(r' z), or NaN if M is not positive definite.
  double preconditioned(const Vector& r, Vector& z) const {
    precondition(r, z);
    set_zero_where(fixed, z);
    return std::sqrt(dot(r, z));
  }
};

bool is_zero_except_where(std::span<const char> fixed, const Vector& x) {
  double largest = 0;
  const auto values = x.owned();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (fixed.empty() || !fixed[i]) largest = std::max(largest, std::abs(values[i]));
  return max_over_ranks(largest, x.layout()->comm) == 0;
}

// The residual's norm when all unknowns but the fixed ones are zero.
double reference_norm(const RestrictedSystem& system, const Vector& x) {
  Vector start(x.layout(), x.block());
  for (std::size_t i = 0; i < system.fixed.size(); ++i)
    if (system.fixed[i]) start.owned()[i] = x.owned()[i];
  Vector r(x.layout(), x.block());
  Vector z(x.layout(), x.block());
  system.full_residual(start, r);
  set_zero_where(system.fixed, r);
  return system.preconditioned(r, z);
}

// Energy norm of the error from rounding x to double precision.
double rounding_floor(const Vector& diagonal, const Vector& x) {
  if (!diagonal.layout()) return 0;
  double sum = 0;
  const auto d = diagonal.owned();
  const auto values = x.owned();
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::max(d[i], 0.0) * values[i] * values[i];
  return epsilon * std::sqrt(sum_over_ranks(sum, x.layout()->comm));
}

// The iterate with the smallest residual so far. It also shows whether the residual still decreases.
class BestIterate {
 public:
  BestIterate(const Vector& x, const Vector& residual, double norm, int patience)
      : x_(x), residual_(residual), norm_(norm), halved_(norm), patience_(patience) {}

  void look_at(const Vector& x, const Vector& residual, double norm) {
    ++steps_since_halved_;
    if (norm < 0.5 * halved_) {
      halved_ = norm;
      steps_since_halved_ = 0;
    }
    if (norm < norm_) {
      norm_ = norm;
      x_ = x;
      residual_ = residual;
    }
  }
  bool has_stagnated() const { return steps_since_halved_ >= patience_; }
  double norm() const { return norm_; }
  const Vector& x() const { return x_; }
  const Vector& residual() const { return residual_; }

 private:
  Vector x_;
  Vector residual_;
  double norm_;
  double halved_;
  int patience_;
  int steps_since_halved_ = 0;
};

// The conjugate direction p: z + beta p with beta = z' (r - r_old) / (z_old' r_old). This form permits residuals that
// are recomputed instead of updated.
class Direction {
 public:
  const Vector& next(const Vector& r, const Vector& z, double norm) {
    if (norm_old_ > 0) {
      const double beta = (norm * norm - dot(z, r_old_)) / (norm_old_ * norm_old_);
      const auto to = p_.owned();
      const auto from = z.owned();
      for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] + beta * to[i];
    } else {
      p_ = z;
    }
    r_old_ = r;
    norm_old_ = norm;
    p_.update_ghosts();
    return p_;
  }

 private:
  Vector p_{};
  Vector r_old_{};
  double norm_old_ = 0;
};

}  // namespace

CgResult conjugate_gradients(const Operator& apply, const Operator& precondition, const Vector& b,
                             std::span<const char> fixed, const Vector& diagonal, Vector& x,
                             const CgSettings& settings) {
  PLASTRON_ASSERT(b.block() == x.block() && b.owned().size() == x.owned().size(), b.block(), x.block(),
                  b.owned().size(), x.owned().size());
  PLASTRON_ASSERT(fixed.empty() || fixed.size() == x.owned().size(), fixed.size(), x.owned().size());
  PLASTRON_ASSERT(!diagonal.layout() || diagonal.owned().size() == x.owned().size(), diagonal.owned().size(),
                  x.owned().size());
  const RestrictedSystem system{apply, precondition, b, fixed};
  Vector full(x.layout(), x.block());
  Vector z(x.layout(), x.block());
  Vector Ap(x.layout(), x.block());
  system.full_residual(x, full);
  Vector r = full;
  set_zero_where(fixed, r);
  double norm = system.preconditioned(r, z);
  const double reference = is_zero_except_where(fixed, x) ? norm : reference_norm(system, x);
  BestIterate best(x, full, norm, settings.patience);
  Direction direction;
  CgResult result;
  const auto reached = [&] { return norm <= settings.tolerance * reference || norm <= rounding_floor(diagonal, x); };
  while (!(result.converged = reached()) && result.steps < settings.max_steps && !best.has_stagnated()) {
    const Vector& p = direction.next(r, z, norm);
    apply(p, Ap);
    const double curvature = dot(p, Ap);
    const double step = dot(p, r) / curvature;
    if (!(curvature > 0) || !std::isfinite(step)) break;
    axpy(step, p, x);
    system.full_residual(x, full);
    r = full;
    set_zero_where(fixed, r);
    norm = system.preconditioned(r, z);
    ++result.steps;
    best.look_at(x, full, norm);
  }
  if (!result.converged) {
    x = best.x();
    full = best.residual();
    norm = best.norm();
  }
  x.update_ghosts();
  result.residual = std::move(full);
  result.relative_residual = reference > 0 ? norm / reference : norm;
  return result;
}

}  // namespace plastron::algebra
