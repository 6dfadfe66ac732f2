// The small system that remains when pressing forces border a linear problem: K x = r with K_kl = z_k' A z_l.
// K is the stiffness of the structure against the forces on an active set. Directions conjugate with respect to K solve
// it. They also show a motion whose stiffness is only rounding.
#pragma once
#include <optional>
#include <span>
#include <vector>

namespace plastron::contact {

/// A symmetric m x m matrix, row-major.
struct SmallMatrix {
  std::size_t size = 0;
  std::vector<double> values{};

  explicit SmallMatrix(std::size_t m) : size(m), values(m * m) {}
  double& operator()(std::size_t k, std::size_t l) { return values[k * size + l]; }
  double operator()(std::size_t k, std::size_t l) const { return values[k * size + l]; }
  /// Returns a' M b.
  double product(std::span<const double> a, std::span<const double> b) const;
};

class Border {
 public:
  /// Makes the border from three matrices of the same motions z_k: `stiffness` with the operator, `factor_stiffness`
  /// with the factorised matrix, `scale` with A's diagonal.
  static Border of(const SmallMatrix& stiffness, const SmallMatrix& factor_stiffness, const SmallMatrix& scale);
  /// A combination whose stiffness is only rounding, by the criterion of algebra::SoftestMotion::is_free(); empty if
  /// there is none. If there is one, K has no inverse.
  const std::vector<double>& free_motion() const { return free_motion_; }
  /// Returns x = K^{-1} r.
  std::vector<double> solve(std::span<const double> r) const;
  /// Returns the x with rows x = values that is nearest to `to` in the energy of K, and the multipliers mu
  /// of x = to - K^{-1} rows' mu. Nothing if the rows are linearly dependent.
  struct Nearest {
    std::vector<double> x, multipliers;
  };
  std::optional<Nearest> nearest(std::span<const double> to, const std::vector<std::vector<double>>& rows,
                                 std::span<const double> values) const;

 private:
  std::vector<std::vector<double>> directions_{};  ///< c_k with c_k' K c_l = 0 for k != l
  std::vector<double> curvatures_{};               ///< c_k' K c_k
  std::vector<double> free_motion_{};
};

}  // namespace plastron::contact
