// Judges a given solution from the case alone (docs/decisions/0011-verification.md): the finest
// mesh, the shell linearised at the stored state, the certificate (docs/model.md, section 8), and the conditions that
// the certificate assumes for our own solvers' results. It factorises nothing and solves nothing.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/problem/problem.hpp>

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

namespace plastron::computation {

/// The data of a solution on the finest mesh that do not follow from the case.
struct StoredSolution {
  assembly::State state{};     ///< state at which its gaps are linearised
  std::vector<double> ways{};  ///< distances by which forces have moved each obstacle since then [m]
  solution::NodalSolution nodal{};
  std::vector<certificate::Station> path{};  ///< states of the path to it, without both ends
};

struct FinestMesh {
  std::shared_ptr<const fem::Space> space{};
  std::shared_ptr<const fem::Surface> surface{};
};
/// Cells that define a mesh that follows from estimates.
struct MeshCells {
  std::vector<mesh::Cuts> cuts{};  ///< mesh::CoarseMesh::cuts
  std::vector<fem::CellPlace> places{};
};

/// Returns the last mesh of solve(). If it follows from estimates, returns the mesh of `cells`, which all ranks give
/// completely. Cells that no such mesh has give another mesh (collective). Throws mesh::DomainError.
FinestMesh finest_mesh(const problem::Problem& problem, MPI_Comm comm, const MeshCells& cells = {});

struct Verification {
  /// Result of solve(), with a single level; the status is solved or inaccurate.
  Result result;
  /// Rows that show that the solution belongs to the case. They need no check for solutions that solve() has found.
  std::vector<certificate::CertificateLimit> membership{};
};

/// Returns the numbers of a solution on a single mesh, without limits, contact zones, estimates, stability and modes
/// (collective).
Result measured_result(const problem::Problem& problem, Solution found);

/// Returns rows that show whether a given solution belongs to its case: in the discrete space, tangent, linearised as the case
/// requires, under the case's load. The certificate does not check this, because solve() makes only such solutions. Rows
/// without a meaning in the problem are left out (collective).
std::vector<certificate::CertificateLimit> membership_rows(const problem::Problem& problem,
                                                           const assembly::DiscreteShell& discrete,
                                                           const solution::NodalSolution& solution,
                                                           const solution::Summary& summary);

/// Verifies a solution (collective). Throws mesh::DomainError, assembly::SupportError, obstacle::ObstacleError, as
/// solve() does.
Verification verify(const problem::Problem& problem, const FinestMesh& mesh, StoredSolution solution);

}  // namespace plastron::computation
