// A distributed symmetric sparse matrix with one dense block per pair of coupled nodes. Only blocks on and above the
// diagonal (in global numbering) are kept: half the memory and half the time to add; a factorisation wants no more.
#pragma once
#include <plastron/algebra/layout.hpp>
#include <plastron/algebra/vector.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::algebra {

/// The node lists of elements (local node indices), one after the other.
struct Connectivity {
  int nodes_per_element = 0;  ///< unless `start` says otherwise
  std::vector<LocalIndex> nodes{};
  std::vector<std::size_t>
      start{};  ///< where each element begins, then the end; empty if all have the same number of nodes
  std::size_t elements() const {
    if (!start.empty()) return start.size() - 1;
    return nodes_per_element ? nodes.size() / static_cast<std::size_t>(nodes_per_element) : 0;
  }
  std::span<const LocalIndex> element(std::size_t e) const {
    if (!start.empty()) return {nodes.data() + start[e], start[e + 1] - start[e]};
    return {nodes.data() + e * static_cast<std::size_t>(nodes_per_element),
            static_cast<std::size_t>(nodes_per_element)};
  }
};

class Matrix {
 public:
  /// Zero, with the exact pattern that `elements` gives: every pair of nodes of an element is coupled. `elements` must
  /// hold every element this rank will add; couplings that other ranks' elements give to nodes owned here are learnt
  /// from them, even between nodes that this rank sees no element of (collective).
  Matrix(std::shared_ptr<const Layout> layout, int block, const Connectivity& elements);
  Matrix(Matrix&&) noexcept;
  Matrix& operator=(Matrix&&) noexcept;
  ~Matrix();

  /// Adds a dense symmetric element matrix, row-major, (nodes * block)^2 values with the block index running fastest.
  /// Only elements of the pattern; each rank adds its own elements. A node may occur twice in `nodes`.
  void add(std::span<const LocalIndex> nodes, std::span<const double> values);
  /// Ends the adding: what was added to rows of other ranks goes there (collective). Adding may go on afterwards.
  void finish();
  void set_zero();  ///< keeps the pattern
  /// What this rank alone has added, A_i, as a matrix on MPI_COMM_SELF whose nodes are all local nodes of layout() in their local order: A is
  /// the sum over ranks of R_i' A_i R_i, with R_i from global to local values. Before finish(), which ships rows of ghosts
  /// away: afterwards, until set_zero(), std::logic_error.
  Matrix local_part() const;
  /// A + factor B, for matrices of one layout, block and pattern (collective).
  Matrix plus_multiple(double factor, const Matrix& B) const;

  /// y = A x, owned values; the ghosts of x are not read, those of y end as zero (collective).
  void multiply(const Vector& x, Vector& y) const;
  /// y = |A| |x| with absolute values of all entries: eps times this bounds the rounding of A x (collective).
  void multiply_absolute(const Vector& x, Vector& y) const;
  Vector diagonal() const;

  const std::shared_ptr<const Layout>& layout() const;
  int block() const;
  std::int64_t nonzeros() const;  ///< of the whole symmetric pattern, over all ranks (collective)

  struct Storage;
  const Storage& storage() const { return *storage_; }

 private:
  explicit Matrix(std::unique_ptr<Storage> storage);
  std::unique_ptr<Storage> storage_;
};

}  // namespace plastron::algebra
