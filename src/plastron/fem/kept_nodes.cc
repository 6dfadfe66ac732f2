#include <plastron/fem/kept_nodes.hpp>

#include <cmath>

namespace plastron::fem {

std::vector<Vector2d> kept_nodes(const CoarseMesh& coarse, int degree) {
  std::vector<Vector2d> nodes;
  const std::vector<Vector2d> of_cell = lattice(coarse.shape, degree % 2 == 0 ? 2 : 1);
  for (const CoarseCell& cell : coarse.cells)
    for (const Vector2d& xi : of_cell) nodes.push_back(cell.map(xi).value);
  return nodes;
}

double point_tolerance(const CoarseMesh& coarse) {
  Vector2d low = Vector2d::Constant(INFINITY), high = -low;
  for (const Vector2d& vertex : coarse.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return 1e-9 * (high - low).maxCoeff();
}

}  // namespace plastron::fem
