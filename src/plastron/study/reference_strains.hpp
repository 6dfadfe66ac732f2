// Strains of coarse solutions at the quadrature points of a finer, nested mesh. With tying (M22) strains belong to the mesh
// on which they were tied: a coarse displacement whose strains are tied again on a finer mesh shows shear it never had.
#pragma once
#include <plastron/computation/result.hpp>

#include <vector>

namespace plastron::study {

class ReferenceStrains {
 public:
  /// (collective)
  explicit ReferenceStrains(const fem::Space& reference);

  /// For each cell that this rank owns on the reference mesh the strains of `coarse` at its quadrature points, components in
  /// that cell's own coordinates. Precondition: every reference cell lies in one cell of the coarse mesh. (collective)
  std::vector<assembly::CellStrain> of(const computation::Solution& coarse) const;

  /// The mesh is the one of the constructor, cell by cell.
  bool fits(const fem::Space& space) const;

 private:
  fem::Cell cell(std::size_t number) const;

  MPI_Comm comm_;
  std::vector<double> cells_;  // of all ranks: coarse, corner, size
  std::vector<int> per_rank_;  // cells
  std::size_t first_ = 0;      // of this rank
};

}  // namespace plastron::study
