// A distributed vector with a block of values per node, ghosts included: one array, owned values first. Solvers wrap
// the array in a PETSc vector for the time of a call (factorisation.cc), so nothing of PETSc is kept here.
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
  /// All zero; `block` values per node. The layout is shared, not copied.
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

  void fill(double value);   ///< ghosts too
  void update_ghosts();      ///< owners' values -> ghosts (collective)
  void accumulate_ghosts();  ///< ghosts' values are added to their owners', then set to zero (collective)

  struct Storage;
  const Storage& storage() const { return *storage_; }
  Storage& storage() { return *storage_; }

 private:
  std::unique_ptr<Storage> storage_;
};

/// Whether every ghost holds its owner's value up to rounding, on all ranks; a NaN equals a NaN (collective). For assertions:
/// as costly as update_ghosts().
bool ghosts_are_current(const Vector& v);

// Over owned values, all ranks (collective).
double dot(const Vector& a, const Vector& b);
double norm(const Vector& a);
double max_abs(const Vector& a);
/// y += s x, owned values.
void axpy(double s, const Vector& x, Vector& y);

// Reductions of one value per rank (collective).
double sum_over_ranks(double value, MPI_Comm comm);
double min_over_ranks(double value, MPI_Comm comm);
double max_over_ranks(double value, MPI_Comm comm);
std::int64_t sum_over_ranks(std::int64_t value, MPI_Comm comm);
/// The values of all ranks one after the other, the same on every rank (collective). For what is small on every rank, or must be
/// whole somewhere. Throws what check_gathered() throws, on all ranks.
std::vector<double> gather_over_ranks(std::span<const double> mine, MPI_Comm comm);
/// Of as many values on every rank, the sums one by one, the same on every rank (collective).
std::vector<double> sums_over_ranks(std::span<const double> mine, MPI_Comm comm);
/// Throws std::length_error for more values than MPI counts in one call, 2^31 - 1 (16 GiB).
void check_gathered(std::int64_t values);

}  // namespace plastron::algebra
