// A distributed symmetric sparse matrix with one dense block for each pair of coupled nodes. Only blocks on and above
// the diagonal (in global numbering) are stored: half the memory and half the time to add. A factorisation needs no
// more.
#pragma once
#include <plastron/algebra/connectivity.hpp>
#include <plastron/algebra/layout.hpp>
#include <plastron/algebra/vector.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::algebra {

struct MatrixStorage;

class Matrix {
 public:
  /// Makes a zero matrix with the exact pattern of `elements`: every pair of nodes of an element is coupled. `elements`
  /// must contain every element that this rank will add. Other ranks report the couplings that their elements give to
  /// nodes owned here, even between nodes of which this rank sees no element (collective).
  Matrix(std::shared_ptr<const Layout> layout, int block, const Connectivity& elements);
  Matrix(Matrix&&) noexcept;
  Matrix& operator=(Matrix&&) noexcept;
  ~Matrix();

  /// Adds a dense symmetric element matrix, row-major, (nodes * block)^2 values with the block index running fastest.
  /// Precondition: the element is in the pattern. Each rank adds its own elements. A node may occur twice in `nodes`.
  void add(std::span<const LocalIndex> nodes, std::span<const double> values);
  /// Ends the adding: sends the values in rows of other ranks to these ranks (collective). Adding may continue
  /// afterwards.
  void finish();
  void set_zero();  ///< keeps the pattern
  /// Returns A + factor B, for matrices of one layout, block and pattern (collective).
  Matrix plus_multiple(double factor, const Matrix& B) const;

  /// Computes y = A x, owned values. It does not read the ghosts of x, and sets the ghosts of y to zero (collective).
  void multiply(const Vector& x, Vector& y) const;
  /// Computes y = |A| |x| with absolute values of all entries. eps times this bounds the rounding of A x (collective).
  void multiply_absolute(const Vector& x, Vector& y) const;
  Vector diagonal() const;

  const std::shared_ptr<const Layout>& layout() const;
  int block() const;
  std::int64_t nonzeros() const;  ///< entries of the whole symmetric pattern, over all ranks (collective)

  const MatrixStorage& storage() const { return *storage_; }

 private:
  explicit Matrix(std::unique_ptr<MatrixStorage> storage);
  std::unique_ptr<MatrixStorage> storage_;
};

}  // namespace plastron::algebra
