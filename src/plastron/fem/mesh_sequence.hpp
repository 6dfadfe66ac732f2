// The sequence of nested meshes on which a problem is solved. It is refined level by level, with interpolation of
// node fields. The coarse mesh's shape selects a sequence of quadrilaterals or of triangles.
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
  /// Completes the space of each level before it is published: adds constraints and the ghosts that they need (collective).
  using Finish = std::function<std::shared_ptr<const Space>(std::shared_ptr<const Space>)>;

  /// Groups of boundaries whose cells must all have one size, so that no node hangs there. A group contains the two
  /// edges of a join, or the edges of a rigid body.
  using Even = std::vector<std::vector<std::string>>;

  /// Makes the coarsest level (collective). Throws DomainError for a degree that the shape does not have and if ranks
  /// have different meshes. Throws the exceptions of `finish`.
  MeshSequence(mesh::CoarseMesh coarse, int degree, MPI_Comm comm, Finish finish = {}, Even even = {});
  ~MeshSequence();
  MeshSequence(MeshSequence&&) noexcept;
  MeshSequence& operator=(MeshSequence&&) noexcept;

  /// The current level. Shared ownership lets results outlive the next refinement.
  std::shared_ptr<const Space> space() const;
  /// Divides every cell in four. Replaces every field (block values per node of the current space) by its interpolant
  /// on the new space (collective).
  void refine(std::span<algebra::Vector> fields);
  /// Divides and joins single cells; fields as above (collective). Marks of the owned cells: 1 to divide in four, 0
  /// to keep, -1 to join with its three sisters if these are marked too. Neighbours differ by one level at most,
  /// cells along even boundaries by none. Therefore more cells may be divided and fewer joined than marked. Triangles
  /// are all divided if some are marked.
  void refine(std::span<algebra::Vector> fields, std::span<const signed char> marks);
  /// Cuts quadrilaterals of the coarse mesh along chords; none may be divided yet. `cuts` of the present coarse cells
  /// are the same on both sides of a common side. Fields as above (collective).
  void cut(std::span<algebra::Vector> fields, std::span<const mesh::Cuts> cuts);
  /// Returns the present cells at a degree higher by `degrees`, finished like every level. Interpolates the fields on
  /// them. The sequence does not change. Null for triangles (collective).
  std::shared_ptr<const Space> raised(std::span<algebra::Vector> fields, int degrees = 1) const;
  /// Restarts from the first mesh with the cuts of another sequence of it, CoarseMesh::cuts (collective). Throws
  /// DomainError for cuts that do not fit.
  void begin_with_cuts(std::vector<mesh::Cuts> cuts);
  /// Whether cells can be divided individually: true for quadrilaterals.
  bool is_graded() const;

 private:
  using Marks = std::optional<std::span<const signed char>>;
  void restart(std::vector<mesh::Cuts> cuts);
  void refine_where(std::span<algebra::Vector> fields, Marks marks);
  void refine_evenly(QuadrilateralSequence& cells, std::span<algebra::Vector> fields, Marks marks);
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

/// Marks all cells along boundaries of a group if one of them is to be divided (collective).
void mark_evenly(const Space& space, const MeshSequence::Even& even, std::span<signed char> marks);

}  // namespace plastron::fem
