#include <plastron/topology/surface_patch.hpp>

namespace plastron::topology {

using Eigen::Vector2d;

namespace {

/// Points and weights that are exact for phi . (a_1 x a_2): degree 3 order - 1 in each coordinate of a quadrilateral,
/// 3 order - 2 in a triangle.
struct CellRule {
  std::vector<Vector2d> xi;
  std::vector<double> weights;
};

CellRule cell_rule(mesh::Shape shape, int order) {
  if (shape == mesh::Shape::triangle) {
    mesh::TriangleRule rule = mesh::triangle_rule(3 * order - 2);
    return {std::move(rule.points), std::move(rule.weights)};
  }
  const mesh::Rule line = mesh::gauss((3 * order + 1) / 2);
  CellRule rule;
  for (std::size_t j = 0; j < line.points.size(); ++j)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      rule.xi.emplace_back(line.points[i], line.points[j]);
      rule.weights.push_back(line.weights[i] * line.weights[j]);
    }
  return rule;
}

}  // namespace

PatchPoints patch_points(const mesh::LatticeTable& table, const SpaceMesh& mesh, const SurfaceCell& cell) {
  const Vector3d origin = mesh.nodes[cell.nodes.front()];  // keeps the digits of small cells far from (0, 0, 0)
  Eigen::MatrixX3d x(static_cast<Eigen::Index>(cell.nodes.size()), 3);
  for (Eigen::Index n = 0; n < x.rows(); ++n) x.row(n) = mesh.nodes[cell.nodes[n]] - origin;
  PatchPoints points{table.value.lazyProduct(x), table.d1.lazyProduct(x), table.d2.lazyProduct(x)};
  points.phi.rowwise() += origin.transpose();
  return points;
}

double degenerate_normal(const PatchPoints& points) {
  constexpr double negligible = 1e-9;
  return negligible * points.a1.rowwise().norm().maxCoeff() * points.a2.rowwise().norm().maxCoeff();
}

std::vector<PatchIntegrals> patch_integrals(const SpaceMesh& mesh, const Vector3d& origin) {
  PatchTables tables(mesh.shape, [&](int order) { return cell_rule(mesh.shape, order).xi; });
  std::map<int, std::vector<double>> weights;
  std::vector<PatchIntegrals> integrals;
  for (const SurfaceCell& cell : mesh.cells) {
    auto& weight = weights[cell.order];
    if (weight.empty()) weight = cell_rule(mesh.shape, cell.order).weights;
    const PatchPoints points = patch_points(tables(cell.order), mesh, cell);
    PatchIntegrals sum;
    for (std::size_t p = 0; p < weight.size(); ++p) {
      const auto row = static_cast<Eigen::Index>(p);
      const Vector3d normal = points.normal(row);
      sum.area += weight[p] * normal.norm();
      sum.area_vector += weight[p] * normal;
      sum.volume += weight[p] * (Vector3d(points.phi.row(row)) - origin).dot(normal) / 3;
    }
    integrals.push_back(sum);
  }
  return integrals;
}

}  // namespace plastron::topology
