// Strains of coarse solutions at the quadrature points of a finer, nested mesh. With tying (M22) strains belong to the mesh
// on which they were tied: a coarse displacement whose strains are tied again on a finer mesh shows shear it never had.
#pragma once
#include <plastron/assembly/shell_operator.hpp>
#include <research/study/gathered_cells.hpp>

#include <mpi.h>

#include <vector>

namespace plastron::study {

class ReferenceStrains {
 public:
  /// (collective)
  explicit ReferenceStrains(const fem::Space& reference);

  /// For each cell that this rank owns on the reference mesh the strains of the nodal field `y` of a coarse mesh at its quadrature
  /// points, components in that cell's own coordinates. Precondition: every reference cell lies in one cell of the coarse mesh, and y has
  /// valid ghosts. (collective)
  std::vector<assembly::CellStrain> of(const assembly::ShellOperator& coarse, const algebra::Vector& y) const;

  /// The mesh is the one of the constructor, cell by cell.
  bool fits(const fem::Space& space) const;

 private:
  MPI_Comm comm_;
  GatheredCells cells_;
};

}  // namespace plastron::study
