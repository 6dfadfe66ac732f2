#include <plastron/meshing/extent.hpp>

#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>

#include <vector>

namespace plastron::meshing {

double extent(const problem::Problem& problem) {
  using Eigen::Vector3d;
  constexpr int enough_cells = 256;
  const fem::Shape shape = problem.discretisation.cells;
  fem::MeshSequence meshes(fem::coarse_mesh(problem.domain, shape), 1, MPI_COMM_SELF);
  while (meshes.space()->global_cells < enough_cells) meshes.refine({});
  const fem::Surface surface(meshes.space()->coarse, problem.charts);
  std::vector<Eigen::Vector2d> xi(static_cast<std::size_t>(fem::corner_count(shape)));
  for (std::size_t k = 0; k < xi.size(); ++k) xi[k] = fem::corner(shape, static_cast<int>(k));
  std::vector<geometry::SurfaceJet> jets(xi.size());
  Vector3d low = Vector3d::Constant(INFINITY), high = -low;
  for (const fem::Cell& cell : meshes.space()->cells) {
    surface.jets(cell, xi, jets, false);
    for (const geometry::SurfaceJet& jet : jets) {
      low = low.cwiseMin(jet.value);
      high = high.cwiseMax(jet.value);
    }
  }
  return (high - low).norm() / 2;
}

}  // namespace plastron::meshing
