#include <plastron/meshing/cell_sizes.hpp>

#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::meshing {

namespace {

using Eigen::Vector3d;

struct CornerPoints {
  std::vector<Vector3d> phi;
  std::vector<double> thickness;
};

CornerPoints corner_points(const problem::Problem& problem, const fem::Surface& surface, const fem::Cell& cell) {
  const fem::Shape shape = problem.discretisation.cells;
  std::vector<Eigen::Vector2d> xi(static_cast<std::size_t>(fem::corner_count(shape)));
  for (std::size_t k = 0; k < xi.size(); ++k) xi[k] = fem::corner(shape, static_cast<int>(k));
  std::vector<geometry::SurfaceJet> jets(xi.size());
  std::vector<double> x(xi.size()), y(xi.size());
  CornerPoints corners{.phi = {}, .thickness = std::vector<double>(xi.size())};
  surface.jets(cell, xi, jets, false);
  surface.positions(cell, xi, x, y);
  problem.shell.sections.at(surface.coarse(), cell).thickness.evaluate(x, y, corners.thickness);
  for (const geometry::SurfaceJet& jet : jets) corners.phi.push_back(jet.value);
  return corners;
}

double longest_side(fem::Shape shape, const CornerPoints& corners) {
  double longest = 0;
  for (int side = 0; side < fem::corner_count(shape); ++side) {
    const auto [from, to] = fem::side_corners(shape, side);
    longest = std::max(
        longest, (corners.phi[static_cast<std::size_t>(to)] - corners.phi[static_cast<std::size_t>(from)]).norm());
  }
  return longest;
}

}  // namespace

std::vector<CellSize> cell_sizes(const problem::Problem& problem) {
  constexpr int enough_cells = 256;
  const problem::Discretisation& d = problem.discretisation;
  fem::MeshSequence meshes(start_mesh(problem).coarse, 1, MPI_COMM_SELF);
  int level = 0;
  for (; meshes.space()->global_cells < enough_cells; ++level) meshes.refine({});
  const fem::Surface surface(meshes.space()->coarse, problem.charts);
  const double to_finest = std::exp2(level - d.refinements);
  std::vector<CellSize> sizes;
  for (const fem::Cell& cell : meshes.space()->cells) {
    const CornerPoints corners = corner_points(problem, surface, cell);
    sizes.push_back({to_finest * longest_side(d.cells, corners), *std::ranges::min_element(corners.thickness)});
  }
  return sizes;
}

}  // namespace plastron::meshing
