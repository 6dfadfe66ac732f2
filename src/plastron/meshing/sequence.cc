#include <plastron/meshing/sequence.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/meshing/start_mesh.hpp>

namespace plastron::meshing {

fem::MeshSequence::Finish joining(const problem::Problem& problem) {
  return [joins = problem.joins, bodies = problem.rigid_bodies,
          charts = problem.charts](std::shared_ptr<const fem::Space> space) {
    const fem::Surface surface(space->coarse, charts);
    return fem::with_rigid_bodies(fem::joined(std::move(space), surface, joins), surface, bodies);
  };
}

fem::MeshSequence::Even even_boundaries(const problem::Problem& problem) {
  fem::MeshSequence::Even even;
  for (const fem::Join& join : problem.joins) even.emplace_back(join.boundaries.begin(), join.boundaries.end());
  for (const fem::RigidBody& body : problem.rigid_bodies) even.push_back(body.boundaries);
  return even;
}

fem::MeshSequence mesh_sequence(const problem::Problem& problem, MPI_Comm comm) {
  // Every rank reads a mesh file that was not shared before, and one rank may find another file or none.
  auto coarse = algebra::in_agreement<mesh::DomainError>(comm, [&] { return start_mesh(problem).coarse; });
  fem::MeshSequence::Even even = even_boundaries(problem);
  for (const std::string& fold : coarse.fold_boundaries) even.push_back({fold});
  return {std::move(coarse), problem.discretisation.degree, comm, joining(problem), std::move(even)};
}

}  // namespace plastron::meshing
