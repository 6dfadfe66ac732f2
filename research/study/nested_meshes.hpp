// Fields and strains carried between a mesh and a nested finer one, across the borders of ranks.
#pragma once
#include <plastron/energy/shell_operator.hpp>

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace plastron::study {

/// The values of the nodal field `y` of a finer, nested mesh at the nodes of `coarse`, block 6 with valid ghosts; y has valid ghosts.
/// Precondition: every cell of `fine` lies in one of `coarse`. (collective)
algebra::Vector values_at_nodes(const fem::Space& coarse, const energy::ShellOperator& fine, const algebra::Vector& y);

/// The cells of a mesh, on every rank.
struct GatheredCells {
  std::vector<fem::Cell> all{};  ///< rank after rank, each in the order of its owned cells
  std::vector<int> per_rank{};
  std::size_t first = 0;  ///< of this rank
  std::size_t mine = 0;
};

/// Strains of coarse solutions at the quadrature points of a finer, nested mesh. With tying (M22) strains belong to the mesh
/// on which they were tied: a coarse displacement whose strains are tied again on a finer mesh shows shear it never had.
class ReferenceStrains {
 public:
  /// (collective)
  explicit ReferenceStrains(const fem::Space& reference);

  /// For each cell that this rank owns on the reference mesh the strains of the nodal field `y` of a coarse mesh at its quadrature
  /// points, components in that cell's own coordinates. Precondition: every reference cell lies in one cell of the coarse mesh, and y has
  /// valid ghosts. (collective)
  std::vector<energy::CellStrain> of(const energy::ShellOperator& coarse, const algebra::Vector& y) const;

  /// The mesh is the one of the constructor, cell by cell.
  bool fits(const fem::Space& space) const;

 private:
  MPI_Comm comm_;
  GatheredCells cells_;
};

}  // namespace plastron::study
