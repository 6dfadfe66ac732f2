// A distributed vector with a block of values per node, including ghosts: one array, owned values first. Solvers wrap
// the array in a PETSc vector during a call (factorisation.cc), so the vector keeps no PETSc data.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace plastron::algebra {

class Vector {
 public:
  Vector();  ///< empty, without a layout
  /// Makes a zero vector with `block` values per node. The layout is shared, not copied.
  Vector(std::shared_ptr<const Layout> layout, int block);
  Vector(const Vector&);
  Vector(Vector&&) noexcept;
  Vector& operator=(const Vector&);
  Vector& operator=(Vector&&) noexcept;
  ~Vector();

  const std::shared_ptr<const Layout>& layout() const;
  int block() const;

  std::span<double> owned();  ///< values of the owned nodes
  std::span<const double> owned() const;
  std::span<double> local();  ///< owned values, then the ghosts'
  std::span<const double> local() const;
  std::span<double> at(std::size_t node);  ///< the block of values of a local node
  std::span<const double> at(std::size_t node) const;

  void fill(double value);   ///< also in ghosts
  void update_ghosts();      ///< copies owners' values to ghosts (collective)
  void accumulate_ghosts();  ///< adds ghosts' values to the owners', then sets them to zero (collective)

  struct Storage;
  const Storage& storage() const { return *storage_; }
  Storage& storage() { return *storage_; }

 private:
  std::unique_ptr<Storage> storage_;
};

/// Whether every ghost has its owner's value up to rounding, on all ranks; a NaN equals a NaN (collective). For
/// assertions: as expensive as update_ghosts().
bool ghosts_are_current(const Vector& v);

// Sums and norms over owned values of all ranks (collective).
double dot(const Vector& a, const Vector& b);
double norm(const Vector& a);
double max_abs(const Vector& a);
/// Adds s x to y, owned values.
void axpy(double s, const Vector& x, Vector& y);

/// Returns the number of this process, from 0 on.
int rank_in(MPI_Comm comm);
// Reductions of one value per rank (collective).
double sum_over_ranks(double value, MPI_Comm comm);
double min_over_ranks(double value, MPI_Comm comm);
double max_over_ranks(double value, MPI_Comm comm);
std::int64_t sum_over_ranks(std::int64_t value, MPI_Comm comm);

}  // namespace plastron::algebra
