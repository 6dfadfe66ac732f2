#include "supernodal_factor.hpp"

#include <plastron/algebra/threads.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace plastron::algebra {
namespace {

/// Returns the number of new border columns that cost as much as a factorisation, by counts. `per_entry` is the time of
/// an entry in operations of a factorisation by one thread.
std::size_t most_new_columns(const FactorisationCost& cost) {
  constexpr double per_entry = 32, fewest = 8;
  return static_cast<std::size_t>(std::max(fewest, price_of(cost).fix / (per_entry * cost.entries_of_path + 1)));
}

/// Calls take(row, column, value) for all entries, with their places in the lower half.
template <class Take>
void for_entries(const MatrixStorage& A, const std::vector<int>& place, const std::vector<double>& fixed, double shift,
                 const Take& take) {
  const auto m = static_cast<std::size_t>(A.block);
  for (LocalIndex row = 0; row < A.layout->owned; ++row)
    for (std::size_t k = A.row_begin(row); k < A.row_end(row); ++k) {
      const bool on_diagonal = A.column[k] == row;
      const std::size_t i0 = static_cast<std::size_t>(row) * m, j0 = static_cast<std::size_t>(A.column[k]) * m;
      const double* B = A.block_at(k);
      for (std::size_t a = 0; a < m; ++a)
        for (std::size_t b = on_diagonal ? a : 0; b < m; ++b) {
          const std::size_t i = i0 + a, j = j0 + b;
          double value = i == j ? (1 + shift) * B[a * m + b] : B[a * m + b];
          if (fixed[i] != 0 || fixed[j] != 0) value = i == j ? fixed[i] : 0.0;
          const auto [column, below] = std::minmax(place[i], place[j]);
          take(below, column, value);
        }
    }
}

/// Returns the lower half by columns, in the order of elimination; the caller frees it.
cholmod_sparse* lower_half(const MatrixStorage& A, const std::vector<int>& place, const std::vector<double>& fixed,
                           double shift, cholmod_common& common) {
  const std::size_t n = A.owned_unknowns();
  std::vector<int> start(n + 1, 0);
  for_entries(A, place, fixed, shift, [&](int, int column, double) { ++start[static_cast<std::size_t>(column) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  cholmod_sparse* half =
      cholmod_allocate_sparse(n, n, static_cast<std::size_t>(start.back()), 0, 1, -1, CHOLMOD_REAL, &common);
  cholmod_check(common, "making room for a matrix");
  std::ranges::copy(start, static_cast<int*>(half->p));
  int* rows = static_cast<int*>(half->i);
  double* values = static_cast<double*>(half->x);
  for_entries(A, place, fixed, shift, [&](int row, int column, double value) {
    const int k = start[static_cast<std::size_t>(column)]++;
    rows[k] = row;
    values[k] = value;
  });
  return half;
}

/// Returns our vector as a CHOLMOD vector.
cholmod_dense column_of(std::vector<double>& values) {
  cholmod_dense dense{};
  dense.nzmax = dense.nrow = dense.d = values.size();
  dense.ncol = 1;
  dense.x = values.data();
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

}  // namespace

SupernodalFactor::SupernodalFactor(const MatrixStorage& A, std::span<const char> movable)
    : A_(A), movable_(movable.begin(), movable.end()) {
  cholmod_start(&common_);
  common_.print = 0;
  analyse();
}

SupernodalFactor::~SupernodalFactor() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

void SupernodalFactor::analyse() {
  cholmod_free_factor(&factor_, &common_);
  elimination_ = eliminate(A_, movable_, common_, factor_);
}

std::vector<char> SupernodalFactor::nearest_fixed(std::span<const char> wanted) const {
  if (movable_.empty() || !is_factorised_) return {};
  std::vector<char> fixed(wanted.begin(), wanted.end());
  const bool is_near = is_within_reach([&](std::size_t i) { return wanted[i] != 0; });
  for (std::size_t i = 0; !is_near && i < fixed.size(); ++i)
    if (!movable_[i]) fixed[i] = is_fixed_in_factor(i);
  return fixed;
}

/// Whether a border of low cost can represent the differences between is_fixed(unknown) and the fixed set of the
/// factor.
template <class IsFixed>
bool SupernodalFactor::is_within_reach(const IsFixed& is_fixed) const {
  constexpr std::size_t most = 256;
  std::size_t others = 0, made = 0;
  for (std::size_t i = 0; i < movable_.size(); ++i)
    if (!movable_[i] && is_fixed(i) != is_fixed_in_factor(i)) {
      ++others;
      made += border_columns_.has(i);
    }
  return others <= most && others - made <= most_new_columns(cost());
}

bool SupernodalFactor::factorise(const std::vector<double>& fixed_diagonal, double shift) {
  border_ = FixedSetBorder();
  const bool is_near = !movable_.empty() && is_factorised_ && shift == shift_ &&
                       is_within_reach([&](std::size_t i) { return fixed_diagonal[i] != 0; });
  if (!is_near && !factorise_all(fixed_diagonal, shift)) return false;
  fixed_ = fixed_diagonal;
  return movable_.empty() || (fix_tail() && fix_border());
}

/// Factorises with no movable unknown fixed. If this leaves a motion free, no unknowns are movable from then on.
bool SupernodalFactor::factorise_all(const std::vector<double>& fixed_diagonal, double shift) {
  const double begin = MPI_Wtime();
  std::vector<double> fixed = fixed_diagonal;
  for (std::size_t i = 0; i < movable_.size(); ++i)
    if (movable_[i]) fixed[i] = 0;
  cholmod_sparse* half = lower_half(A_, elimination_.place, fixed, shift, common_);
  {
    const BlasThreads threads(threads_now_for(elimination_.cost.operations));
    cholmod_factorize(half, factor_, &common_);
  }
  cholmod_free_sparse(&half, &common_);
  ++factorisations_;
  cholmod_check(common_, "factorising a matrix");
  seconds_ += MPI_Wtime() - begin;
  is_factorised_ = common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  shift_ = shift;
  fixed_in_factor_ = std::move(fixed);
  if (is_factorised_) take_tail();
  border_columns_ = BorderColumns(A_, shift_, *factor_, elimination_.place, fixed_in_factor_);
  if (is_factorised_ || movable_.empty()) return is_factorised_;
  movable_.clear();
  analyse();
  return factorise_all(fixed_diagonal, shift);
}

void SupernodalFactor::take_tail() {
  const auto size = static_cast<std::size_t>(elimination_.last), n = factor_->n, first = n - size;
  if (size == 0) {
    tail_ = TailComplement();
    return;
  }
  std::vector<double> L(size * size, 0.0);
  const int *super = static_cast<int*>(factor_->super), *pi = static_cast<int*>(factor_->pi),
            *px = static_cast<int*>(factor_->px), *s = static_cast<int*>(factor_->s);
  const double* x = static_cast<double*>(factor_->x);
  for (std::size_t k = 0; k < factor_->nsuper; ++k) {
    const int length = pi[k + 1] - pi[k];
    for (int c = 0; c < super[k + 1] - super[k]; ++c) {
      const auto column = static_cast<std::size_t>(super[k] + c);
      for (int r = c; column >= first && r < length; ++r)
        L[(column - first) * size + static_cast<std::size_t>(s[pi[k] + r]) - first] = x[px[k] + c * length + r];
    }
  }
  tail_ = TailComplement(size, std::move(L));
}

bool SupernodalFactor::fix_tail() {
  std::vector<char> fixed(tail_.size());
  const std::size_t first = A_.owned_unknowns() - tail_.size();
  for (std::size_t i = 0; i < movable_.size(); ++i)
    if (movable_[i]) fixed[static_cast<std::size_t>(elimination_.place[i]) - first] = fixed_[i] != 0;
  return tail_.fix(fixed);
}

bool SupernodalFactor::fix_border() {
  std::vector<std::size_t> let_go, fixed;
  for (std::size_t i = 0; i < movable_.size(); ++i) {
    if (!movable_[i] && fixed_[i] == 0 && is_fixed_in_factor(i)) let_go.push_back(i);
    if (!movable_[i] && fixed_[i] != 0 && !is_fixed_in_factor(i)) fixed.push_back(i);
  }
  border_ = FixedSetBorder(std::move(let_go), fixed, border_columns_, tail_, A_.owned_unknowns());
  return border_.is_regular();
}

void SupernodalFactor::solve(std::span<const double> b, std::span<double> x) {
  if (b.empty()) return;
  const bool moves = !movable_.empty();
  const auto place = [&](std::size_t i) { return static_cast<std::size_t>(elimination_.place[i]); };
  ordered_.resize(b.size());
  space_.resize(std::max<std::size_t>(1, factor_->maxesize));
  for (std::size_t i = 0; i < b.size(); ++i)
    ordered_[place(i)] = moves && (fixed_[i] != 0 || is_fixed_in_factor(i)) ? 0 : b[i];
  std::vector<double> at_let_go;
  for (const std::size_t i : border_.let_go()) at_let_go.push_back(b[i]);
  cholmod_dense right = column_of(ordered_), work = column_of(space_);
  cholmod_super_lsolve(factor_, &right, &work, &common_);
  tail_.solve(std::span(ordered_).last(tail_.size()));
  border_.correct(ordered_, at_let_go);
  cholmod_super_ltsolve(factor_, &right, &work, &common_);
  for (std::size_t i = 0; i < b.size(); ++i) x[i] = moves && fixed_[i] != 0 ? b[i] / fixed_[i] : ordered_[place(i)];
  for (std::size_t k = 0; k < at_let_go.size(); ++k) x[border_.let_go()[k]] = at_let_go[k];
}

}  // namespace plastron::algebra
