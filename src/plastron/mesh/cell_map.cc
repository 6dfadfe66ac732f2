#include <plastron/mesh/cell_map.hpp>

#include <plastron/mesh/basis.hpp>

#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace plastron::mesh {

namespace {

// Separate code for straight sides, which almost all cells of mesh files have: tables of polynomials take several
// times as long.

PlaneJet bilinear(const std::vector<Vector2d>& p, const Vector2d& xi) {
  const Vector2d along = p[1] - p[0], across = p[2] - p[0], twist = p[3] - p[2] - along;
  PlaneJet f;
  f.value = p[0] + xi[0] * along + xi[1] * across + xi[0] * xi[1] * twist;
  f.d = {along + xi[1] * twist, across + xi[0] * twist};
  f.dd[1] = twist;
  return f;
}

PlaneJet linear(const std::vector<Vector2d>& p, const Vector2d& xi) {
  PlaneJet f;
  f.d = {p[1] - p[0], p[2] - p[0]};
  f.value = p[0] + xi[0] * f.d[0] + xi[1] * f.d[1];
  return f;
}

PlaneJet polynomial(Shape shape, int order, const std::vector<Vector2d>& nodes, const Vector2d& xi) {
  const LatticeValues basis = lattice_values(shape, order, xi);
  PlaneJet f;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    f.value += basis.value[at] * nodes[i];
    for (std::size_t a = 0; a < 2; ++a) f.d[a] += basis.d[a][at] * nodes[i];
    for (std::size_t k = 0; k < 3; ++k) f.dd[k] += basis.dd[k][at] * nodes[i];
  }
  return f;
}

}  // namespace

CurveJet Segment::operator()(double t) const { return {from + t * (to - from), to - from, Vector2d::Zero()}; }

CurveJet Arc::operator()(double t) const {
  const double rate = angle_to - angle_from, angle = angle_from + t * rate;
  const Vector2d radial = radius * Vector2d(std::cos(angle), std::sin(angle));
  return {centre + radial, rate * Vector2d(-radial[1], radial[0]), -rate * rate * radial};
}

PlaneJet BlendedMap::operator()(const Vector2d& xi) const {
  const auto at = [](const Edge& edge, double t) { return std::visit([t](const auto& e) { return e(t); }, edge); };
  const double s = xi[0], t = xi[1];
  const CurveJet l = at(left, t), r = at(right, t), b = at(bottom, s), u = at(top, s);
  const Vector2d p00 = at(bottom, 0).value, p10 = at(bottom, 1).value, p01 = at(top, 0).value, p11 = at(top, 1).value;
  PlaneJet f;
  f.value = (1 - s) * l.value + s * r.value + (1 - t) * b.value + t * u.value -
            ((1 - s) * (1 - t) * p00 + s * (1 - t) * p10 + (1 - s) * t * p01 + s * t * p11);
  f.d[0] = r.value - l.value + (1 - t) * b.d + t * u.d - ((1 - t) * (p10 - p00) + t * (p11 - p01));
  f.d[1] = (1 - s) * l.d + s * r.d + u.value - b.value - ((1 - s) * (p01 - p00) + s * (p11 - p10));
  f.dd[0] = (1 - t) * b.dd + t * u.dd;
  f.dd[1] = r.d - l.d + u.d - b.d - (p11 - p01 - p10 + p00);
  f.dd[2] = (1 - s) * l.dd + s * r.dd;
  return f;
}

PlaneJet LagrangeMap::operator()(const Vector2d& xi) const {
  return order == 1 ? bilinear(nodes, xi) : polynomial(Shape::quadrilateral, order, nodes, xi);
}

PlaneJet TriangleLagrangeMap::operator()(const Vector2d& xi) const {
  return order == 1 ? linear(nodes, xi) : polynomial(Shape::triangle, order, nodes, xi);
}

PlaneJet CellMap::operator()(const Vector2d& xi) const {
  const PlaneJet f = std::visit([&](const auto& m) { return m(origin + axes * xi); }, map);
  PlaneJet g;
  g.value = f.value;
  for (int a = 0; a < 2; ++a) g.d[a] = f.d[0] * axes(0, a) + f.d[1] * axes(1, a);
  constexpr int row[3] = {0, 0, 1}, column[3] = {0, 1, 1};
  for (int k = 0; k < 3; ++k) {
    const auto p = axes.col(row[k]), q = axes.col(column[k]);
    g.dd[k] = f.dd[0] * (p[0] * q[0]) + f.dd[1] * (p[0] * q[1] + p[1] * q[0]) + f.dd[2] * (p[1] * q[1]);
  }
  return g;
}

std::optional<Vector2d> invert_map(Shape shape, const CellMap& map, const Vector2d& point) {
  // Part of the cell's size; points far from the origin have larger rounding.
  constexpr double tolerance = 1e-9;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * point.norm();
  Vector2d xi = centre(shape);
  double size = 0;
  for (int step = 0; step < 30; ++step) {
    const PlaneJet f = map(xi);
    Eigen::Matrix2d jacobian;
    jacobian << f.d[0], f.d[1];
    size = jacobian.norm();
    const Vector2d change = jacobian.fullPivLu().solve(point - f.value);
    xi += change;
    if (change.norm() < 1e-14) break;
    if (!(xi.norm() < 10)) break;
  }
  const Vector2d inside = put_inside(shape, xi);
  if (!((map(inside).value - point).norm() <= tolerance * size + rounding)) return std::nullopt;
  return inside;
}

}  // namespace plastron::mesh
