// Cholesky factor of one rank's matrix with some unknowns pinned, by CHOLMOD's supernodes. Unknowns whose pins will
// probably change are eliminated last and pinned only in their Schur complement: one factor of the rest serves all their
// pins. A few others that change nevertheless form a border. Both are in pin_border.hpp.
// Includes CHOLMOD: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation.hpp>

#include <span>
#include <vector>

#include "elimination.hpp"
#include "matrix_storage.hpp"
#include "pin_border.hpp"

namespace plastron::algebra {

class SupernodalFactor {
 public:
  /// Analyses the pattern. movable[i] != 0 for unknowns that must come last; may be empty.
  SupernodalFactor(const Matrix::Storage& A, std::span<const char> movable);
  ~SupernodalFactor();
  SupernodalFactor(const SupernodalFactor&) = delete;
  SupernodalFactor& operator=(const SupernodalFactor&) = delete;

  /// Factorises A + shift diag(A). A diagonal matrix replaces the rows and columns of the pinned unknowns:
  /// `pinned_diagonal` where it is not 0. Returns false if a pivot is not positive.
  bool factorise(const std::vector<double>& pinned_diagonal, double shift);
  /// Returns `wanted` if it needs no new full factor. Otherwise returns the wanted pins of movable unknowns and the
  /// factor's pins of all others. Empty before a factorisation or if no unknowns are movable.
  std::vector<char> nearest_pins(std::span<const char> wanted) const;
  void solve(std::span<const double> b, std::span<double> x);

  const FactorisationCost& cost() const { return elimination_.cost; }
  int factorisations() const { return factorisations_; }  ///< without changes of tail and border alone
  double seconds() const { return seconds_; }             ///< time of these factorisations [s]

 private:
  void analyse();
  template <class IsPinned>
  bool is_within_reach(const IsPinned& is_pinned) const;
  bool factorise_all(const std::vector<double>& pinned_diagonal, double shift);
  bool pin_tail();
  bool pin_border();
  bool is_pinned_in_factor(std::size_t i) const { return factor_pins_[i] != 0; }
  void take_tail();

  const Matrix::Storage& A_;
  std::vector<char> movable_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  Elimination elimination_{};
  TailComplement tail_{};
  BorderColumns border_columns_{};
  PinBorder border_{};
  std::vector<double> factor_pins_{};        ///< the diagonal where the factor has pinned it, else 0
  std::vector<double> pins_{};               ///< the same, including tail and border
  std::vector<double> ordered_{}, space_{};  ///< scratch of solve()
  double shift_ = 0;
  bool is_factorised_ = false;  ///< except for the Schur complement
  int factorisations_ = 0;
  double seconds_ = 0;
};

}  // namespace plastron::algebra
