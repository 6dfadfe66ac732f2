#include <plastron/contact/border.hpp>

#include <limits>

namespace plastron::contact {
namespace {

/// Whether the stiffness c' K c is only rounding. c is the part of the k-th motion that remains after the earlier
/// directions.
bool costs_nothing(const SmallMatrix& K, const SmallMatrix& factor, const SmallMatrix& scale, std::span<const double> c,
                   std::size_t k) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr double nothing_but_rounding = 4 * epsilon, unlike_its_factor = 1e-3;
  constexpr double dependent = 256 * epsilon;  // part of K_kk that remains after the other directions are subtracted
  const double stiffness = K.product(c, c);
  return !(stiffness > nothing_but_rounding * scale.product(c, c)) ||
         !(stiffness > unlike_its_factor * factor.product(c, c)) || !(stiffness > dependent * K(k, k));
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

double SmallMatrix::product(std::span<const double> a, std::span<const double> b) const {
  double sum = 0;
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t l = 0; l < size; ++l) sum += a[k] * (*this)(k, l) * b[l];
  return sum;
}

Border Border::of(const SmallMatrix& stiffness, const SmallMatrix& factor_stiffness, const SmallMatrix& scale) {
  Border border;
  for (std::size_t k = 0; k < stiffness.size; ++k) {
    std::vector<double> unit(stiffness.size, 0.0);
    unit[k] = 1;
    std::vector<double> c = unit;
    for (std::size_t l = 0; l < k; ++l) {
      const double part = stiffness.product(border.directions_[l], unit) / border.curvatures_[l];
      for (std::size_t i = 0; i <= l; ++i) c[i] -= part * border.directions_[l][i];
    }
    if (costs_nothing(stiffness, factor_stiffness, scale, c, k)) {
      border.free_motion_ = std::move(c);
      return border;
    }
    border.curvatures_.push_back(stiffness.product(c, c));
    border.directions_.push_back(std::move(c));
  }
  return border;
}

std::vector<double> Border::solve(std::span<const double> r) const {
  std::vector<double> x(r.size(), 0.0);
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const double along = dot(directions_[k], r);
    for (std::size_t i = 0; i < r.size(); ++i) x[i] += along / curvatures_[k] * directions_[k][i];
  }
  return x;
}

std::optional<Border::Nearest> Border::nearest(std::span<const double> to, const std::vector<std::vector<double>>& rows,
                                               std::span<const double> values) const {
  std::vector<std::vector<double>> answers;
  answers.reserve(rows.size());
  for (const auto& row : rows) answers.push_back(solve(row));
  SmallMatrix compliance(rows.size());
  std::vector<double> excess;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (std::size_t l = 0; l < rows.size(); ++l) compliance(k, l) = dot(rows[k], answers[l]);
    excess.push_back(dot(rows[k], to) - values[k]);
  }
  const SmallMatrix none(rows.size());
  const Border small = of(compliance, none, none);
  if (!small.free_motion().empty()) return {};
  Nearest found{.x = std::vector<double>(to.begin(), to.end()), .multipliers = small.solve(excess)};
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t i = 0; i < to.size(); ++i) found.x[i] -= found.multipliers[k] * answers[k][i];
  return found;
}

}  // namespace plastron::contact
