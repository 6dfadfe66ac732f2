#include <plastron/fem/shape_field.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace plastron::fem {

namespace {

using mesh::Vector2d;
using topology::SpaceBox;

/// Part of a cell's length by which a point may lie outside all cells: their sides are polynomials, those of the domain may be
/// arcs.
constexpr double margin = 0.1;

/// Returns the boxes around the cells, wider by the margin. The nodes of a curved side need not reach as far as the side.
std::vector<SpaceBox> boxes_around(const ShapeField::Cells& cells, std::size_t nodes_per_cell) {
  std::vector<SpaceBox> boxes;
  for (std::size_t first = 0; first < cells.points.size(); first += nodes_per_cell) {
    SpaceBox box;
    for (std::size_t i = first; i < first + nodes_per_cell; ++i) box.add({cells.points[i][0], cells.points[i][1], 0});
    boxes.push_back(box.widened(margin * (box.high - box.low).maxCoeff()));
  }
  return boxes;
}

/// Returns the distance by which a point lies outside the reference cell; negative inside.
double excess(mesh::Shape shape, const Vector2d& xi) {
  const double below = -xi.minCoeff();
  return std::max(below, shape == mesh::Shape::triangle ? xi.sum() - 1 : xi.maxCoeff() - 1);
}

}  // namespace

ShapeField::ShapeField(Cells cells)
    : cells_(std::move(cells)),
      nodes_(mesh::gauss_lobatto(cells_.degree + 1).points),
      boxes_(boxes_around(cells_, nodes_per_cell())) {
  PLASTRON_ASSERT(cells_.points.size() == cells_.values.size() && cells_.points.size() % nodes_per_cell() == 0,
                  cells_.points.size(), cells_.values.size());
}

std::size_t ShapeField::nodes_per_cell() const {
  return static_cast<std::size_t>(mesh::nodes_per_cell(cells_.shape, cells_.degree));
}

ShapeField::Basis ShapeField::basis(const Vector2d& xi) const {
  if (cells_.shape == mesh::Shape::triangle) {
    mesh::LatticeValues values = mesh::lattice_values(cells_.shape, cells_.degree, xi);
    return {std::move(values.value), std::move(values.d[0]), std::move(values.d[1])};
  }
  const mesh::LagrangeValues first = mesh::lagrange(nodes_, xi[0]), second = mesh::lagrange(nodes_, xi[1]);
  const auto product = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return Eigen::VectorXd((a * b.transpose()).reshaped());
  };
  return {product(first.value, second.value), product(first.d, second.value), product(first.value, second.d)};
}

Eigen::Matrix<double, 2, 3> ShapeField::place(std::size_t cell, const Basis& basis) const {
  Eigen::Matrix<double, 2, 3> sum = Eigen::Matrix<double, 2, 3>::Zero();
  const std::size_t count = nodes_per_cell();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d& x = cells_.points[cell * count + i];
    const auto k = static_cast<Eigen::Index>(i);
    sum.col(0) += basis.value[k] * x;
    sum.col(1) += basis.d1[k] * x;
    sum.col(2) += basis.d2[k] * x;
  }
  return sum;
}

/// Newton's method from `start`. Returns nothing where it does not converge, as far outside the cell.
std::optional<Vector2d> ShapeField::inverse(std::size_t cell, const Vector2d& point, Vector2d start) const {
  constexpr int most_steps = 30;
  constexpr double tolerance = 1e-13, small = 1e-6, far = 3;  // in reference coordinates
  Vector2d xi = std::move(start);
  double last = far;
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::Matrix<double, 2, 3> at = place(cell, basis(xi));
    const Vector2d change = at.rightCols<2>().inverse() * (point - at.col(0));
    xi += change;
    if (!(xi.lpNorm<Eigen::Infinity>() < far)) return {};
    const double length = change.norm();
    if (length <= tolerance || (length < small && length > last / 2)) return xi;  // rounding: addresses are large
    last = length;
  }
  return {};
}

ShapeField::Found ShapeField::find(const Vector2d& inside) const {
  Found best{};
  double least = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d corner(inside[0], inside[1], 0);
  boxes_.visit({.low = corner, .high = corner}, [&](std::size_t cell) {
    if (least < 0) return;
    const std::optional<Vector2d> xi = inverse(cell, inside, mesh::centre(cells_.shape));
    if (!xi || !(excess(cells_.shape, *xi) < least)) return;
    least = excess(cells_.shape, *xi);
    best = {cell, *xi};
  });
  if (!(least <= margin))
    throw mesh::DomainError(fmt::format("the mode has no value at x = {:.6g}, y = {:.6g}: it belongs to another domain",
                                        inside[0], inside[1]));
  return best;
}

mesh::SurfaceShift::Jet ShapeField::at(const Vector2d& point, const Vector2d& inside) const {
  const Found found = find(inside);
  const Basis basis = this->basis(inverse(found.cell, point, found.xi).value_or(found.xi));
  const Eigen::Matrix2d to_xi = place(found.cell, basis).rightCols<2>().inverse();
  Vector6 value = Vector6::Zero();
  std::array<Vector6, 2> along_xi{Vector6::Zero(), Vector6::Zero()};
  const std::size_t count = nodes_per_cell();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector6& at_node = cells_.values[found.cell * count + i];
    const auto k = static_cast<Eigen::Index>(i);
    value += basis.value[k] * at_node;
    along_xi[0] += basis.d1[k] * at_node;
    along_xi[1] += basis.d2[k] * at_node;
  }
  Jet jet{.u = value.head<3>(), .r = value.tail<3>()};
  for (int a = 0; a < 2; ++a) {
    const Vector6 d = to_xi(0, a) * along_xi[0] + to_xi(1, a) * along_xi[1];
    jet.du[static_cast<std::size_t>(a)] = d.head<3>();
    jet.dr[static_cast<std::size_t>(a)] = d.tail<3>();
  }
  return jet;
}

mesh::Vector3d ShapeField::place_at(const Vector2d& point) const {
  const Found found = find(point);
  const Basis basis = this->basis(found.xi);
  mesh::Vector3d phi = mesh::Vector3d::Zero();
  const std::size_t count = nodes_per_cell();
  for (std::size_t i = 0; i < count; ++i)
    phi += basis.value[static_cast<Eigen::Index>(i)] * cells_.places[found.cell * count + i];
  return phi;
}

std::array<Vector2d, 2> ShapeField::box() const {
  std::array<Vector2d, 2> box{cells_.points.front(), cells_.points.front()};
  for (const Vector2d& x : cells_.points) box = {box[0].cwiseMin(x), box[1].cwiseMax(x)};
  return box;
}

}  // namespace plastron::fem
