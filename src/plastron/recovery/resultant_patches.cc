#include <plastron/recovery/resultant_patches.hpp>

#include <array>
#include <utility>

#include "vertex_entry.hpp"

namespace plastron::recovery {

namespace {

/// Bilinear on quadrilaterals, barycentric on triangles.
double corner_weight(fem::Shape shape, int corner, const Eigen::Vector2d& xi) {
  if (shape == fem::Shape::quadrilateral)
    return (corner % 2 == 1 ? xi[0] : 1 - xi[0]) * (corner >= 2 ? xi[1] : 1 - xi[1]);
  return corner == 0 ? 1 - xi[0] - xi[1] : xi[corner - 1];
}

std::vector<CellResultants> all_resultants(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  const ResultantPoints take(discrete);
  std::vector<CellResultants> all;
  all.reserve(discrete.space().owned_cells);
  for (std::size_t cell = 0; cell < discrete.space().owned_cells; ++cell)
    all.push_back(take(cell, discrete.shell.gather(cell, solution.y)));
  return all;
}

}  // namespace

ResultantPatches::ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution, int degree)
    : shape_(discrete.space().shape()) {
  const auto resultants = all_resultants(discrete, solution);
  patches_ = std::make_shared<const Patches>(discrete, resultants, degree);
  fit(resultants);
}

ResultantPatches::ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                                   std::shared_ptr<const Patches> patches)
    : shape_(discrete.space().shape()), patches_(std::move(patches)) {
  fit(all_resultants(discrete, solution));
}

void ResultantPatches::fit(const std::vector<CellResultants>& cells) {
  const Eigen::Index terms = patches_->terms();
  coefficients_ = algebra::Vector(patches_->vertices().layout(), static_cast<int>(8 * terms));
  const auto at = [&](algebra::LocalIndex vertex) {
    return Eigen::Map<Eigen::MatrixXd>(entry(coefficients_, vertex).data(), terms, 8);
  };
  patches_->for_points(
      cells, [&](algebra::LocalIndex vertex, const Patches::Plane& plane, const CellResultants& cell, std::size_t p) {
        const Resultants here(cell.values.row(static_cast<Eigen::Index>(p)));
        at(vertex) += patches_->basis(plane, cell.position[p]).transpose() *
                      in_other_axes(here, change_of_axes(cell.axes[p], plane.axes));
      });
  coefficients_.accumulate_ghosts();
  for (algebra::LocalIndex vertex = 0; vertex < patches_->vertices().layout()->owned; ++vertex)
    at(vertex) = patches_->solve(vertex, at(vertex));
  coefficients_.update_ghosts();
}

std::optional<Resultants> ResultantPatches::at(std::size_t cell, const Eigen::Vector2d& xi, const Vector3d& position,
                                               const SurfaceAxes& axes) const {
  std::array<algebra::LocalIndex, 4> patches{};
  std::array<double, 4> weights{};
  std::size_t count = 0;
  double total = 0;
  const Patches::Kind wanted = patches_->best(cell);
  if (wanted == Patches::Kind::none) return std::nullopt;
  for (int k = 0; k < fem::corner_count(shape_); ++k) {
    const algebra::LocalIndex vertex = patches_->vertex(cell, k);
    if (patches_->kind(vertex) != wanted) continue;
    patches[count] = vertex;
    weights[count] = corner_weight(shape_, k, xi);
    total += weights[count++];
  }
  Resultants sum = Resultants::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Patches::Plane& plane = patches_->plane(patches[i]);
    const Eigen::Map<const Eigen::MatrixXd> coefficients(entry(coefficients_, patches[i]).data(), patches_->terms(), 8);
    const double weight = weights[i] + (1 - total) / static_cast<double>(count);
    sum += weight *
           in_other_axes(Resultants(patches_->basis(plane, position) * coefficients), change_of_axes(plane.axes, axes));
  }
  return sum;
}

}  // namespace plastron::recovery
