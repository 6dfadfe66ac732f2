#include <plastron/recovery/resultant_patches.hpp>

#include <algorithm>
#include <utility>

namespace plastron::recovery {

namespace {

/// Weight of a corner: bilinear on quadrilaterals, barycentric on triangles.
double corner_weight(mesh::Shape shape, int corner, const Eigen::Vector2d& xi) {
  if (shape == mesh::Shape::quadrilateral)
    return (corner % 2 == 1 ? xi[0] : 1 - xi[0]) * (corner >= 2 ? xi[1] : 1 - xi[1]);
  return corner == 0 ? 1 - xi[0] - xi[1] : xi[corner - 1];
}

std::vector<CellResultants> all_resultants(const assembly::DiscreteShell& discrete, assembly::FieldKind kind,
                                           const algebra::Vector& y) {
  const ResultantPoints take(discrete, kind);
  std::vector<CellResultants> all;
  all.reserve(discrete.space().owned_cells);
  for (std::size_t cell = 0; cell < discrete.space().owned_cells; ++cell)
    all.push_back(take(cell, discrete.shell.gather(cell, y)));
  return all;
}

}  // namespace

int patch_degree(const fem::Space& space) {
  return space.degree < 3 ? space.degree : std::min(space.degree + space.degree / 2, Patches::most_degree);
}

ResultantPatches::ResultantPatches(const assembly::DiscreteShell& discrete, const NodalSolution& solution, int degree)
    : shape_(discrete.space().shape()) {
  const auto resultants = all_resultants(discrete, assembly::FieldKind::solution, solution.y);
  patches_ = std::make_shared<const Patches>(discrete, resultants, degree);
  fit(resultants);
}

ResultantPatches::ResultantPatches(const assembly::DiscreteShell& discrete, const algebra::Vector& motion,
                                   std::shared_ptr<const Patches> patches)
    : shape_(discrete.space().shape()), patches_(std::move(patches)) {
  fit(all_resultants(discrete, assembly::FieldKind::motion, motion));
}

void ResultantPatches::fit(const std::vector<CellResultants>& cells) {
  const Eigen::Index terms = patches_->terms();
  coefficients_ = algebra::Vector(patches_->vertices().layout(), static_cast<int>(8 * terms));
  const auto at = [&](algebra::LocalIndex vertex) {
    return Eigen::Map<Eigen::MatrixXd>(coefficients_.at(vertex).data(), terms, 8);
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

std::vector<std::pair<algebra::LocalIndex, double>> ResultantPatches::blended(std::size_t cell,
                                                                              const Eigen::Vector2d& xi) const {
  std::vector<std::pair<algebra::LocalIndex, double>> vertices;
  const Patches::Kind wanted = patches_->best(cell);
  if (wanted == Patches::Kind::none) return vertices;
  double total = 0;
  for (int k = 0; k < mesh::corner_count(shape_); ++k) {
    const algebra::LocalIndex vertex = patches_->vertex(cell, k);
    if (patches_->kind(vertex) != wanted) continue;
    vertices.emplace_back(vertex, corner_weight(shape_, k, xi));
    total += vertices.back().second;
  }
  for (auto& [vertex, weight] : vertices) weight += (1 - total) / static_cast<double>(vertices.size());
  return vertices;
}

std::optional<Resultants> ResultantPatches::at(std::size_t cell, const Eigen::Vector2d& xi, const Vector3d& position,
                                               const SurfaceAxes& axes) const {
  const auto vertices = blended(cell, xi);
  if (vertices.empty()) return std::nullopt;
  Resultants sum = Resultants::Zero();
  for (const auto& [vertex, weight] : vertices) {
    const Patches::Plane& plane = patches_->plane(vertex);
    const Eigen::Map<const Eigen::MatrixXd> coefficients(coefficients_.at(vertex).data(), patches_->terms(), 8);
    sum += weight *
           in_other_axes(Resultants(patches_->basis(plane, position) * coefficients), change_of_axes(plane.axes, axes));
  }
  return sum;
}

// The transpose of fit() and at(). It goes from the point to the polynomials, and through the symmetric normal
// equations to the points of the patches' cells. From the resultants there it leads to the cells' nodes.
void ResultantPatches::add_transposed(const assembly::DiscreteShell& discrete, const std::optional<Weighed>& point,
                                      algebra::Vector& f) const {
  const Eigen::Index terms = patches_->terms();
  algebra::Vector weights(patches_->vertices().layout(), static_cast<int>(8 * terms));
  const auto at = [&](algebra::LocalIndex vertex) {
    return Eigen::Map<Eigen::MatrixXd>(weights.at(vertex).data(), terms, 8);
  };
  if (point)
    for (const auto& [vertex, share] : blended(point->cell, point->xi)) {
      const Patches::Plane& plane = patches_->plane(vertex);
      at(vertex) += share * patches_->basis(plane, point->position).transpose() *
                    in_other_axes_transposed(point->weights, change_of_axes(plane.axes, point->axes));
    }
  weights.accumulate_ghosts();
  for (algebra::LocalIndex vertex = 0; vertex < patches_->vertices().layout()->owned; ++vertex)
    at(vertex) = patches_->solve(vertex, at(vertex));
  weights.update_ghosts();
  const ResultantPoints take(discrete, assembly::FieldKind::motion);
  for (std::size_t cell = 0; cell < discrete.space().owned_cells; ++cell) {
    const auto touched = [&](int k) {
      const algebra::LocalIndex vertex = patches_->vertex(cell, k);
      return patches_->plane(vertex).most != Patches::Kind::none && !at(vertex).isZero(0);
    };
    int count = 0;
    for (int k = 0; k < mesh::corner_count(shape_); ++k) count += touched(k) ? 1 : 0;
    if (count == 0) continue;
    element::CellField unit = element::CellField::Zero(discrete.space().nodes_per_cell(), 6), forces = unit;
    const CellResultants points = take(cell, unit);
    ResultantRows of_points = ResultantRows::Zero(points.values.rows(), 8);
    for (int k = 0; k < mesh::corner_count(shape_); ++k) {
      if (!touched(k)) continue;
      const algebra::LocalIndex vertex = patches_->vertex(cell, k);
      const Patches::Plane& plane = patches_->plane(vertex);
      for (std::size_t p = 0; p < points.position.size(); ++p)
        of_points.row(static_cast<Eigen::Index>(p)) +=
            in_other_axes_transposed(Resultants(patches_->basis(plane, points.position[p]) * at(vertex)),
                                     change_of_axes(points.axes[p], plane.axes));
    }
    for (Eigen::Index i = 0; i < unit.size(); ++i) {
      unit.data()[i] = 1;
      forces.data()[i] = take(cell, unit).values.cwiseProduct(of_points).sum();
      unit.data()[i] = 0;
    }
    discrete.shell.scatter(cell, forces, f);
  }
}

}  // namespace plastron::recovery
