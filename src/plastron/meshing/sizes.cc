#include <plastron/meshing/sizes.hpp>

#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/meshing/constants.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::meshing {

namespace {

using Eigen::Vector2d, Eigen::Vector3d;

/// Divides cells until there are enough for a sample. Returns the number of divisions.
int refine_for_samples(fem::MeshSequence& meshes) {
  int level = 0;
  for (; meshes.space()->global_cells < constants.sampled_cells; ++level) meshes.refine({});
  return level;
}

std::vector<Vector2d> corners_of(mesh::Shape shape) {
  std::vector<Vector2d> xi(static_cast<std::size_t>(mesh::corner_count(shape)));
  for (std::size_t k = 0; k < xi.size(); ++k) xi[k] = mesh::corner(shape, static_cast<int>(k));
  return xi;
}

double longest_side(mesh::Shape shape, const std::vector<geometry::Frame>& corners) {
  double longest = 0;
  for (int side = 0; side < mesh::corner_count(shape); ++side) {
    const auto [from, to] = mesh::side_corners(shape, side);
    longest = std::max(longest, (corners[to].phi - corners[from].phi).norm());
  }
  return longest;
}

}  // namespace

double extent(const problem::Problem& problem) {
  const mesh::Shape shape = problem.discretisation.cells;
  fem::MeshSequence meshes(domain::coarse_mesh(problem.domain, shape), 1, MPI_COMM_SELF);
  refine_for_samples(meshes);
  const fem::Surface surface(meshes.space()->coarse, problem.charts);
  const std::vector<Vector2d> xi = corners_of(shape);
  std::vector<geometry::Frame> frames(xi.size());
  Vector3d low = Vector3d::Constant(INFINITY), high = -low;
  for (const fem::Cell& cell : meshes.space()->cells) {
    surface.frames(cell, xi, frames, false);
    for (const geometry::Frame& frame : frames) {
      low = low.cwiseMin(frame.phi);
      high = high.cwiseMax(frame.phi);
    }
  }
  return (high - low).norm() / 2;
}

std::vector<CellSize> cell_sizes(const problem::Problem& problem) {
  const problem::Discretisation& d = problem.discretisation;
  fem::MeshSequence meshes(start_mesh(problem).coarse, 1, MPI_COMM_SELF);
  const int level = refine_for_samples(meshes);
  const fem::Surface surface(meshes.space()->coarse, problem.charts);
  const double to_finest = std::exp2(level - d.refinements);
  const std::vector<Vector2d> xi = corners_of(d.cells);
  std::vector<geometry::Frame> frames(xi.size());
  std::vector<double> thickness(xi.size());
  std::vector<CellSize> sizes;
  for (const fem::Cell& cell : meshes.space()->cells) {
    surface.frames(cell, xi, frames, false);
    surface.evaluate(problem.shell.sections.at(surface.coarse(), cell).thickness, cell, xi, thickness);
    sizes.push_back({to_finest * longest_side(d.cells, frames), *std::ranges::min_element(thickness)});
  }
  return sizes;
}

}  // namespace plastron::meshing
