// The few equations that bordering a linear problem by pressing forces leaves: K x = r with K_kl = z_k' A z_l, the stiffness that the structure
// offers the forces on an active set. Solved in directions conjugate with respect to K, which show a motion that only rounding holds.
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
  /// a' M b
  double product(std::span<const double> a, std::span<const double> b) const;
};

class Border {
 public:
  /// `stiffness` with the operator, `factor_stiffness` with the matrix that was factorised, `scale` with A's diagonal, all of the same motions
  /// z_k.
  static Border of(const SmallMatrix& stiffness, const SmallMatrix& factor_stiffness, const SmallMatrix& scale);
  /// A combination that costs nothing but rounding, judged like algebra::SoftestMotion::is_free(); empty if there is none. With one, K has no
  /// inverse.
  const std::vector<double>& free_motion() const { return free_motion_; }
  /// x = K^{-1} r
  std::vector<double> solve(std::span<const double> r) const;
  /// Of all x with rows x = values the one nearest to `to` in the energy of K, and the multipliers mu of x = to - K^{-1} rows' mu. Nothing
  /// if the rows depend on each other.
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
