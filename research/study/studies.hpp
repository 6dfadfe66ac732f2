// The studies (docs/research). Each takes a problem, is collective, and returns a report. kinds.hpp lists them by name.
// The variants of a study are the problems that it computes besides the case.
#pragma once
#include <research/names/study_names.hpp>
#include <research/study/report.hpp>

#include <mpi.h>

#include <vector>

namespace plastron::study {

/// How fast the error falls with the mesh size, with both sides of Falk's estimate: the paper's Theorem 5.
Report convergence(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                   const StudyObserver& observer);

/// The cost of an accuracy on graded and on uniform meshes, and the true errors beside the estimated ones.
Report adaptivity(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);

/// |U_p - U|_a for p = 1, 1/10, ... until the mesh locks: the paper's Theorem 3 and Remark 4.
Report penalty(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
               const StudyObserver& observer);
std::vector<Variant> penalty_variants(const problem::Problem& problem, const StudyOptions& options);

/// The limit of zero thickness, dominated by bending or by the membrane.
Report thickness(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer);
std::vector<Variant> thickness_study_variants(const problem::Problem& problem, const StudyOptions& options);

/// The change of the solution under random changes of load, thickness and obstacle, against proven bounds.
Report continuity(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);
std::vector<Variant> continuity_variants(const problem::Problem& problem, const StudyOptions& options);

/// The constants of coercivity and of the inf-sup conditions over mesh size and thickness.
Report stability(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                 const StudyObserver& observer);
std::vector<Variant> stability_variants(const problem::Problem& problem, const StudyOptions& options);

/// The softest modes of the shell without supports, in every formulation, over the mesh size.
Report soft_modes(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                  const StudyObserver& observer);

/// All formulations on one mesh sequence. A row for each formulation and mesh: energy, reaction, contact area, max |r . a_3|,
/// norm of lambda, unknowns, steps, seconds, and the differences from the tangent formulation on the same mesh.
/// Formulations that the case rules out become remarks.
Report compare(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
               const StudyObserver& observer);

/// All contact solvers on one mesh sequence. A row for each solver: seconds of the contact solution, iterations (with those of a
/// safeguard), conjugate-gradient steps and factorisations, summed over the meshes; the energy 1/2 a(U, U) of the finest mesh, its
/// relative difference from the first solver's, and whether the certificate holds.
/// Claims: each solver finds the first one's energy to 1e-8, and a certificate that holds.
Report compare_solvers(const problem::Problem& problem, const StudyOptions& options, MPI_Comm comm,
                       const StudyObserver& observer);

}  // namespace plastron::study
