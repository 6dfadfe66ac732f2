// The sequence of nested meshes on which a problem is solved, refined level by level, with node fields carried along.
// Quadrilaterals and triangles have a sequence each; the coarse mesh's shape decides.
#pragma once
#include <plastron/fem/space.hpp>

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plastron::fem {

class QuadrilateralSequence;

class MeshSequence {
 public:
  /// What is made of the space of each level before anybody sees it: ties, and the ghosts that they need (collective).
  using Finish = std::function<std::shared_ptr<const Space>(std::shared_ptr<const Space>)>;

  /// Boundaries along which all cells are to have one size, so that no node hangs there: the two edges of a join, the edges of a rigid body.
  using Even = std::vector<std::vector<std::string>>;

  /// The coarsest level (collective). Throws DomainError for a degree that the shape does not have, where ranks
  /// bring different meshes, and what `finish` throws.
  MeshSequence(CoarseMesh coarse, int degree, MPI_Comm comm, Finish finish = {}, Even even = {});
  ~MeshSequence();
  MeshSequence(MeshSequence&&) noexcept;

  /// The current level. Shared, so that results outlive the next refinement.
  std::shared_ptr<const Space> space() const;
  /// Divides every cell in four; every field (block values per node of the current space) is replaced by its
  /// interpolant on the new one (collective).
  void refine(std::span<algebra::Vector> fields);
  /// The same cell by cell: marks of the owned cells are 1 to divide in four, 0 to keep, -1 to make one again with its three sisters if these
  /// are marked, too. Neighbours differ by one level at most, and cells along even boundaries by none, so that more cells
  /// may be divided and fewer joined than marked. Triangles are all divided if some are marked. (collective)
  void refine(std::span<algebra::Vector> fields, std::span<const signed char> marks);
  /// Cuts quadrilaterals of the coarse mesh, none of which may be divided yet, along chords: `cuts` of the present coarse cells are the same on
  /// both sides of a common side. Fields as above. (collective)
  void cut(std::span<algebra::Vector> fields, std::span<const Cuts> cuts);
  /// The present cells at a degree that is higher by `degrees`, finished like every level, with fields interpolated on them; the sequence stays
  /// as it is. Null for triangles. (collective)
  std::shared_ptr<const Space> raised(std::span<algebra::Vector> fields, int degrees = 1) const;
  /// Begins anew with the first mesh at the cuts that another sequence of it has come to, CoarseMesh::cuts (collective). Throws DomainError for
  /// cuts that do not fit.
  void begin_with_cuts(std::vector<Cuts> cuts);
  /// Whether cells can be divided one by one: quadrilaterals can.
  bool is_graded() const;

 private:
  using Marks = std::optional<std::span<const signed char>>;
  void restart(std::vector<Cuts> cuts);
  void refine_where(std::span<algebra::Vector> fields, Marks marks);
  void refine_evenly(QuadrilateralSequence& cells, std::span<algebra::Vector> fields, Marks marks);
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

/// Adds to the marks all cells along boundaries of a group where one of them is to be divided (collective).
void mark_evenly(const Space& space, const MeshSequence::Even& even, std::span<signed char> marks);

}  // namespace plastron::fem
