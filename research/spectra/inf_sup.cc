#include <research/spectra/spectra.hpp>

#include <plastron/algebra/eigenvalues.hpp>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/energy/normal_rotation.hpp>

#include <cmath>
#include <stdexcept>

namespace plastron::spectra {

namespace {

using algebra::Vector;

void clear(std::span<const char> marks, Vector& v) {
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) v.owned()[i] = 0;
}

/// The eigenvalue at one end. A few digits more than anybody reads.
double extreme(const algebra::SelfAdjointOperator& T, algebra::End end) {
  const auto pairs = algebra::eigenpairs(T, end, {.count = 1, .tolerance = 1e-6, .max_restarts = 1000});
  if (!pairs.converged) throw std::runtime_error("an inf-sup constant was not found: the eigenvalue did not converge");
  return pairs.values.at(0);
}

/// Nodes without a multiplier. That of the first obstacle is measured: its gap is the first coordinate wherever it is one.
std::vector<char> without_multiplier(const assembly::DiscreteShell& discrete) {
  std::vector<char> marks(static_cast<std::size_t>(discrete.space().layout->owned));
  const assembly::NodalCoordinates& c = discrete.coordinates;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto rows = c.rows_of(i);
    marks[i] = rows.empty() || rows[0].coordinate != 0 || c.basis[i].col(0).head<3>().norm() == 0;
  }
  return marks;
}

/// w -> S w: the Schur complement of X on the coordinate w of the nodes with a multiplier.
class Lifting {
 public:
  Lifting(const assembly::DiscreteShell& discrete, double length, std::span<const char> without)
      : width_(static_cast<std::size_t>(discrete.coordinates.width)),
        without_(without),
        X_(h1_matrix(discrete.shell, discrete.coordinates, length)),
        factor_(X_),
        held_(discrete.coordinates.prescribed()),
        z_(X_.layout(), X_.block()),
        force_(z_),
        reply_(z_) {
    for (std::size_t i = 0; i < without.size(); ++i)
      if (!without[i]) held_[width_ * i] = 1;
    if (!factor_.factorise(held_)) throw std::runtime_error("the matrix of the H1 norm is not positive definite");
  }

  void apply(const Vector& w, Vector& Sw) {
    z_.fill(0);
    for (std::size_t i = 0; i < without_.size(); ++i)
      if (!without_[i]) z_.owned()[width_ * i] = w.owned()[i];
    X_.multiply(z_, force_);
    clear(held_, force_);
    factor_.solve(force_, reply_);
    algebra::axpy(-1, reply_, z_);
    X_.multiply(z_, force_);
    for (std::size_t i = 0; i < without_.size(); ++i) Sw.owned()[i] = without_[i] ? 0 : force_.owned()[width_ * i];
  }

 private:
  std::size_t width_;
  std::span<const char> without_;
  algebra::Matrix X_;
  algebra::Factorisation factor_;
  std::vector<char> held_;
  Vector z_, force_, reply_;
};

double dual_inf_sup(const assembly::DiscreteShell& discrete, double length, std::span<const char> without,
                    Lifting& lifting) {
  const algebra::Matrix K = scalar_h1_matrix(discrete.shell, length);
  algebra::Factorisation factor(K);
  if (!factor.factorise(without)) throw std::runtime_error("the matrix of the H1 norm is not positive definite");
  Vector Sw(K.layout(), 1);
  const double largest = extreme({K.layout(), 1,
                                  [&](const Vector& w, Vector& result) {
                                    lifting.apply(w, Sw);
                                    factor.solve(Sw, result);
                                  },
                                  [&](const Vector& w, Vector& Kw) { K.multiply(w, Kw); }, without},
                                 algebra::End::largest);
  return 1 / std::sqrt(largest);
}

double l2_inf_sup(const assembly::DiscreteShell& discrete, double length, std::span<const char> without,
                  Lifting& lifting) {
  const double unit = std::pow(length, 4);  // of an area and of the square of a gap
  const auto weight = [&](std::size_t i) { return discrete.points[i].weight / unit; };
  // M = W here: with t = W eta the sum of weight eta^2 is t' W^{-1} t, and its dual in w is w' W w.
  const double largest = extreme({discrete.space().layout, 1,
                                  [&](const Vector& w, Vector& result) {
                                    lifting.apply(w, result);
                                    for (std::size_t i = 0; i < result.owned().size(); ++i)
                                      result.owned()[i] /= weight(i);
                                  },
                                  [&](const Vector& w, Vector& Ww) {
                                    for (std::size_t i = 0; i < Ww.owned().size(); ++i)
                                      Ww.owned()[i] = weight(i) * w.owned()[i];
                                  },
                                  without},
                                 algebra::End::largest);
  return 1 / std::sqrt(largest);
}

}  // namespace

std::optional<double> tangency_inf_sup(const assembly::DiscreteShell& discrete, double length) {
  const auto& layout = discrete.space().layout;
  const auto zeros = assembly::multiplier_zeros(discrete.coordinates, *layout);
  std::int64_t count = 0;
  for (const char zero : zeros) count += zero;
  count = algebra::sum_over_ranks(count, layout->comm);
  if (count == 0 || count == layout->global_size) return {};

  const algebra::Matrix X = h1_matrix(discrete.shell, discrete.coordinates, length),
                        K = gradient_matrix(discrete.shell);
  algebra::Factorisation X_factor(X), K_factor(K);
  const auto fixed = discrete.coordinates.prescribed();
  if (!X_factor.factorise(fixed) || !K_factor.factorise(zeros))
    throw std::runtime_error("a matrix of the inf-sup constant of b is not positive definite");
  Vector y(layout, 6), force(layout, X.block()), z(force), Bz(layout, 1), spread(Bz);
  // K^{-1} B X^{-1} B'
  const auto apply = [&](const Vector& q, Vector& result) {
    spread = q;
    apply_coupling_transposed(discrete.shell, spread, y);
    force.fill(0);
    discrete.coordinates.add_transposed(y, force);
    clear(fixed, force);
    X_factor.solve(force, z);
    z.update_ghosts();
    discrete.coordinates.to_cartesian(z, y);
    apply_coupling(discrete.shell, y, Bz);
    clear(zeros, Bz);
    K_factor.solve(Bz, result);
  };
  const double smallest = extreme({layout, 1, apply, [&](const Vector& q, Vector& Kq) { K.multiply(q, Kq); }, zeros},
                                  algebra::End::smallest);
  return std::sqrt(std::max(0.0, smallest));
}

std::optional<ContactInfSup> contact_inf_sup(const assembly::DiscreteShell& discrete, double length) {
  const auto without = without_multiplier(discrete);
  std::int64_t with = 0;
  for (const char none : without) with += !none;
  with = algebra::sum_over_ranks(with, discrete.space().layout->comm);
  if (with == 0) return {};
  Lifting lifting(discrete, length, without);
  return ContactInfSup{.dual = dual_inf_sup(discrete, length, without, lifting),
                       .l2 = l2_inf_sup(discrete, length, without, lifting),
                       .multipliers = with};
}

}  // namespace plastron::spectra
