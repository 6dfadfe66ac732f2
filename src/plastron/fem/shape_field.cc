#include <plastron/fem/shape_field.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/mesh/basis.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <utility>

namespace plastron::fem {

namespace {

using mesh::Vector2d;
using topology::SpaceBox;

/// Part of a cell's length by which a point may lie outside all cells: their sides are polynomials, those of the domain may be
/// arcs.
constexpr double margin = 0.1;

/// Tolerances of reference coordinates: to find the cell, and to evaluate in it.
constexpr double rough = 1e-6, exact = 1e-13;

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

/// Evaluates at at.xi.
void ShapeField::evaluate(std::size_t cell, Evaluation& at) const {
  const Vector2d& xi = at.xi;
  if (cells_.shape == mesh::Shape::triangle) {
    mesh::LatticeValues values = mesh::lattice_values(cells_.shape, cells_.degree, xi);
    at.value = std::move(values.value);
    at.d1 = std::move(values.d[0]);
    at.d2 = std::move(values.d[1]);
  } else {
    const mesh::LagrangeValues first = mesh::lagrange(nodes_, xi[0]), second = mesh::lagrange(nodes_, xi[1]);
    const Eigen::Index n = first.value.size();
    for (Eigen::VectorXd* values : {&at.value, &at.d1, &at.d2}) values->resize(n * n);
    for (Eigen::Index j = 0; j < n; ++j) {
      at.value.segment(j * n, n) = second.value[j] * first.value;
      at.d1.segment(j * n, n) = second.value[j] * first.d;
      at.d2.segment(j * n, n) = second.d[j] * first.value;
    }
  }
  const auto count = static_cast<Eigen::Index>(nodes_per_cell());
  const Eigen::Map<const Eigen::Matrix2Xd> points(cells_.points[cell * nodes_per_cell()].data(), 2, count);
  at.place.noalias() = points * at.value;
  at.derivatives.col(0).noalias() = points * at.d1;
  at.derivatives.col(1).noalias() = points * at.d2;
}

/// Newton's method from at.xi, up to a step that is shorter than the tolerance: at.xi is the point after it, the rest of `at` belongs to
/// the point before. Returns false where it does not converge, as far outside the cell.
bool ShapeField::invert(std::size_t cell, const Vector2d& point, double tolerance, Evaluation& at) const {
  constexpr int most_steps = 30;
  constexpr double small = 1e-6, far = 3;  // in reference coordinates
  double last = far;
  for (int step = 0; step < most_steps; ++step) {
    evaluate(cell, at);
    const Vector2d change = at.derivatives.inverse() * (point - at.place);
    at.xi += change;
    if (!(at.xi.lpNorm<Eigen::Infinity>() < far)) return false;
    const double length = change.norm();
    if (length <= tolerance || (length < small && length > last / 2)) return true;  // rounding: addresses are large
    last = length;
  }
  return false;
}

/// Returns the cell of a point, and its coordinates there up to a tolerance.
ShapeField::Found ShapeField::find(const Vector2d& inside, double tolerance, Evaluation& at) const {
  Found best{};
  double least = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d corner(inside[0], inside[1], 0);
  boxes_.visit({.low = corner, .high = corner}, [&](std::size_t cell) {
    if (least < 0) return;
    at.xi = mesh::centre(cells_.shape);
    if (!invert(cell, inside, tolerance, at) || !(excess(cells_.shape, at.xi) < least)) return;
    least = excess(cells_.shape, at.xi);
    best = {cell, at.xi};
  });
  if (!(least <= margin))
    throw mesh::DomainError(fmt::format("the mode has no value at x = {:.6g}, y = {:.6g}: it belongs to another domain",
                                        inside[0], inside[1]));
  return best;
}

mesh::SurfaceShift::Jet ShapeField::at(const Vector2d& point, const Vector2d& inside) const {
  Evaluation at;
  const Found found = find(inside, rough, at);
  at.xi = found.xi;
  if (!invert(found.cell, point, exact, at)) {
    at.xi = found.xi;
    evaluate(found.cell, at);
  }
  const Eigen::Matrix2d to_xi = at.derivatives.inverse();
  const std::size_t count = nodes_per_cell();
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> values(cells_.values[found.cell * count].data(), 6,
                                                                          static_cast<Eigen::Index>(count));
  const Vector6 value = values * at.value, along_1 = values * at.d1, along_2 = values * at.d2;
  Jet jet{.u = value.head<3>(), .r = value.tail<3>()};
  for (int a = 0; a < 2; ++a) {
    const Vector6 d = to_xi(0, a) * along_1 + to_xi(1, a) * along_2;
    jet.du[static_cast<std::size_t>(a)] = d.head<3>();
    jet.dr[static_cast<std::size_t>(a)] = d.tail<3>();
  }
  return jet;
}

mesh::Vector3d ShapeField::place_at(const Vector2d& point) const {
  Evaluation at;
  const Found found = find(point, exact, at);
  at.xi = found.xi;
  evaluate(found.cell, at);
  mesh::Vector3d phi = mesh::Vector3d::Zero();
  const std::size_t count = nodes_per_cell();
  for (std::size_t i = 0; i < count; ++i)
    phi += at.value[static_cast<Eigen::Index>(i)] * cells_.places[found.cell * count + i];
  return phi;
}

std::array<Vector2d, 2> ShapeField::box() const {
  std::array<Vector2d, 2> box{cells_.points.front(), cells_.points.front()};
  for (const Vector2d& x : cells_.points) box = {box[0].cwiseMin(x), box[1].cwiseMax(x)};
  return box;
}

}  // namespace plastron::fem
