// The constants of coercivity and of the inf-sup conditions on a sequence of meshes and for a sequence of thicknesses: all are
// extreme eigenvalues; no load and no solution enters.
#pragma once
#include <research/study/kinds.hpp>

#include <limits>

namespace plastron::study {

/// One thickness on one mesh. NaN where a constant is not defined.
struct StabilitySample {
  static constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

  double factor = 1;
  double thickness = 0;  ///< mean e [m]
  int level = 0;
  double mesh_size = 0;  ///< h, of a cell [m]
  std::int64_t nodes = 0;
  double alpha = no_value, relative_alpha = no_value;       ///< [J]; relative: alpha / (E e^3)
  double b = no_value, c_dual = no_value, c_l2 = no_value;  ///< inf-sup constants
};

/// From thick to thin, for each thickness from coarse to fine; norms with the unit of length `length` [m]. Empty if
/// interrupted. (collective)
std::vector<StabilitySample> stability_samples(const problem::Problem& problem, const std::vector<double>& factors,
                                               double length, MPI_Comm comm, const StudyObserver& observer);

}  // namespace plastron::study
