// Cholesky factor of one rank's matrix with some unknowns pinned, by CHOLMOD's supernodes. Unknowns whose pins will probably change are
// eliminated last and pinned in their Schur complement alone (tail_complement.hpp): one factor of the rest serves all their pins. A few others
// that change nevertheless become a border (pin_border.hpp).
// Includes CHOLMOD: for .cc files only.
#pragma once
#include <plastron/algebra/factorisation.hpp>

#include <span>
#include <vector>

#include "elimination.hpp"
#include "matrix_storage.hpp"
#include "pin_border.hpp"
#include "tail_complement.hpp"

namespace plastron::algebra {

class SupernodalFactor {
 public:
  /// Analyses the pattern. movable[i] != 0 for unknowns to come last; may be empty.
  SupernodalFactor(const Matrix::Storage& A, std::span<const char> movable);
  ~SupernodalFactor();
  SupernodalFactor(const SupernodalFactor&) = delete;
  SupernodalFactor& operator=(const SupernodalFactor&) = delete;

  /// Of A + shift diag(A) with the pinned unknowns' rows and columns replaced by those of a diagonal matrix, `pinned_diagonal` where that is
  /// not 0. False if a pivot is not positive.
  bool factorise(const std::vector<double>& pinned_diagonal, double shift);
  /// `wanted` where that is had without another factor of all; else the wanted pins of movable unknowns and the factor's of all others. Empty before a factorisation or where none are movable.
  std::vector<char> nearest_pins(std::span<const char> wanted) const;
  void solve(std::span<const double> b, std::span<double> x);

  const FactorisationCost& cost() const { return elimination_.cost; }
  int factorisations() const { return factorisations_; }  ///< tail and border alone not counted
  double seconds() const { return seconds_; }             ///< spent on those

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
  std::vector<double> factor_pins_{};        ///< the diagonal where the factor has it pinned, else 0
  std::vector<double> pins_{};               ///< the same with tail and border
  std::vector<double> ordered_{}, space_{};  ///< of solve()
  double shift_ = 0;
  bool is_factorised_ = false;  ///< but for the Schur complement
  int factorisations_ = 0;
  double seconds_ = 0;
};

}  // namespace plastron::algebra
