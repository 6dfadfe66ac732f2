// Cholesky factor of one rank's matrix with some unknowns fixed, by CHOLMOD's supernodes. Unknowns that will probably
// be fixed or released are eliminated last and fixed only in their Schur complement: one factor of the rest serves all
// their sets. A few others that change nevertheless form a border. Both are in fixed_set_border.hpp.
// Includes CHOLMOD: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation_cost.hpp>

#include <span>
#include <vector>

#include "elimination.hpp"
#include "fixed_set_border.hpp"
#include "matrix_storage.hpp"

namespace plastron::algebra {

class SupernodalFactor {
 public:
  /// Analyses the pattern. movable[i] != 0 for unknowns that must come last; may be empty.
  SupernodalFactor(const MatrixStorage& A, std::span<const char> movable);
  ~SupernodalFactor();
  SupernodalFactor(const SupernodalFactor&) = delete;
  SupernodalFactor& operator=(const SupernodalFactor&) = delete;

  /// Factorises A + shift diag(A). A diagonal matrix replaces the rows and columns of the fixed unknowns:
  /// `fixed_diagonal` where it is not 0. Returns false if a pivot is not positive.
  bool factorise(const std::vector<double>& fixed_diagonal, double shift);
  /// Returns `wanted` if it needs no new full factor. Otherwise returns the wanted set of movable unknowns and the
  /// factor's set of all others. Empty before a factorisation or if no unknowns are movable.
  std::vector<char> nearest_fixed(std::span<const char> wanted) const;
  void solve(std::span<const double> b, std::span<double> x);

  const FactorisationCost& cost() const { return elimination_.cost; }
  int factorisations() const { return factorisations_; }  ///< without changes of tail and border alone
  double seconds() const { return seconds_; }             ///< time of these factorisations [s]

 private:
  void analyse();
  template <class IsFixed>
  bool is_within_reach(const IsFixed& is_fixed) const;
  bool factorise_all(const std::vector<double>& fixed_diagonal, double shift);
  bool fix_tail();
  bool fix_border();
  bool is_fixed_in_factor(std::size_t i) const { return fixed_in_factor_[i] != 0; }
  void take_tail();

  const MatrixStorage& A_;
  std::vector<char> movable_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  Elimination elimination_{};
  TailComplement tail_{};
  BorderColumns border_columns_{};
  FixedSetBorder border_{};
  std::vector<double> fixed_in_factor_{};    ///< the diagonal where the factor fixes the unknown, else 0
  std::vector<double> fixed_{};              ///< the same, including tail and border
  std::vector<double> ordered_{}, space_{};  ///< scratch of solve()
  double shift_ = 0;
  bool is_factorised_ = false;  ///< except for the Schur complement
  int factorisations_ = 0;
  double seconds_ = 0;
};

}  // namespace plastron::algebra
