// Marks the cells that the next mesh divides or joins, from the estimated errors of the goals.
#pragma once
#include <plastron/estimation/goal_record.hpp>
#include <plastron/fem/space.hpp>

#include <mpi.h>

#include <vector>

namespace plastron::meshing {

/// Returns for each owned cell the largest error that any goal has in it, relative to the allowed error.
std::vector<double> error_indicators(const fem::Space& space, const std::vector<estimation::GoalRecord>& goals,
                                     const estimation::Estimates& estimates);

/// Returns the largest threshold above which cells contain `share` of the whole, to within a hundredth. The tolerance
/// ensures that rounding does not separate cells that are equal by symmetry (collective).
double error_threshold(const std::vector<double>& indicators, double share, MPI_Comm comm);

/// Returns marks of the owned cells for fem::MeshSequence::refine. Divided are the cells that contain `share` of all
/// errors, with each goal's error relative to its allowed error (Doerfler, SIAM J. Numer. Anal. 33, 1996), and unjudged
/// cells. Cells are joined again if their part then stays negligible (collective).
std::vector<signed char> marks(const fem::Space& space, const std::vector<estimation::GoalRecord>& goals,
                               const estimation::Estimates& estimates, double share);

}  // namespace plastron::meshing
