// The sequence of nested meshes on which a problem is solved, refined level by level, with node fields carried along.
// Quadrilaterals and triangles have a sequence each; the coarse mesh's shape decides.
#pragma once
#include <plastron/fem/space.hpp>

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

namespace plastron::fem {

class MeshSequence {
 public:
  /// The coarsest level (collective). Throws DomainError for a degree that the shape does not have, and where ranks bring different
  /// meshes.
  MeshSequence(CoarseMesh coarse, int degree, MPI_Comm comm);
  ~MeshSequence();
  MeshSequence(MeshSequence&&) noexcept;

  /// The current level. Shared, so that results outlive the next refinement.
  std::shared_ptr<const Space> space() const;
  /// Divides every cell in four; every field (block values per node of the current space) is replaced by its
  /// interpolant on the new one (collective).
  void refine(std::span<algebra::Vector> fields);

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace plastron::fem
