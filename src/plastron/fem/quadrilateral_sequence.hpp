// Nested meshes of quadrilaterals: a distributed quadtree over the coarse mesh, refined level by level, everywhere or
// locally. Only this part of the program uses deal.II's meshes.
#pragma once
#include <plastron/fem/space.hpp>

#include <mpi.h>

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace plastron::fem {

class QuadrilateralSequence {
 public:
  /// Makes the coarsest level (collective).
  QuadrilateralSequence(mesh::CoarseMesh coarse, int degree, MPI_Comm comm);
  ~QuadrilateralSequence();
  QuadrilateralSequence(QuadrilateralSequence&&) noexcept;
  QuadrilateralSequence& operator=(QuadrilateralSequence&&) noexcept;

  /// Marks of the owned cells; without marks all are divided.
  using Marks = std::optional<std::span<const signed char>>;

  std::shared_ptr<const Space> space() const;
  /// Returns the present cells in the same order with nodes of another degree (collective).
  std::shared_ptr<const Space> space_of_degree(int degree) const;
  /// See MeshSequence::refine.
  void refine(std::span<algebra::Vector> fields, Marks marks);

 private:
  struct Nodes;
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

/// Returns the version of deal.II, whose quadtree the sequence uses.
std::string deal_ii_version();

}  // namespace plastron::fem
