// A solution that somebody hands over, judged from the case alone (docs/decisions/0011-verification.md): the finest
// mesh, the shell linearised where the solution says it was, the certificate (docs/model.md, section 8), and what the
// certificate takes for granted of our own solvers' results. Nothing is factorised, nothing is solved.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/fem/surface.hpp>

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

namespace plastron::computation {

/// What a solution on the finest mesh is, apart from all that follows from the case.
struct StoredSolution {
  assembly::State state{};     ///< where its gaps are linearised
  std::vector<double> ways{};  ///< how far forces have pressed each obstacle on from there [m]
  certificate::NodalSolution nodal{};
};

struct FinestMesh {
  std::shared_ptr<const fem::Space> space{};
  std::shared_ptr<const fem::Surface> surface{};
};
/// What tells a mesh that follows from estimates.
struct MeshCells {
  std::vector<fem::Cuts> cuts{};  ///< fem::CoarseMesh::cuts
  std::vector<fem::CellPlace> places{};
};

/// The mesh that solve() ends on; where that follows from estimates, the mesh of these cells, which all ranks give whole. Cells that no such
/// mesh has give another mesh (collective). Throws fem::DomainError.
FinestMesh finest_mesh(const Problem& problem, MPI_Comm comm, const MeshCells& cells = {});

struct Verification {
  /// As solve() would have left it, with a single level; the status is solved or inaccurate.
  Result result;
  /// That the solution is one of the case's kind: rows that say nothing of solutions that solve() has found.
  std::vector<certificate::CertificateLimit> membership{};
};

/// (collective) Throws fem::DomainError, assembly::SupportError, obstacle::ObstacleError, as solve() does.
Verification verify(const Problem& problem, const FinestMesh& mesh, StoredSolution solution);

}  // namespace plastron::computation
