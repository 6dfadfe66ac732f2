#include <plastron/mesh/reference_cell.hpp>

namespace plastron::mesh {

namespace {

constexpr std::array<int, 2> square_sides[4] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};

bool runs_clockwise(Shape shape, int side) { return shape == Shape::quadrilateral && (side == 0 || side == 3); }

}  // namespace

int corner_count(Shape shape) { return shape == Shape::triangle ? 3 : 4; }

Vector2d corner(Shape, int k) {
  const int column = k % 2, row = k / 2;
  return {static_cast<double>(column), static_cast<double>(row)};
}

Vector2d centre(Shape shape) { return Vector2d::Constant(shape == Shape::triangle ? 1.0 / 3 : 0.5); }

int nodes_per_cell(Shape shape, int degree) {
  return shape == Shape::triangle ? (degree + 1) * (degree + 2) / 2 : (degree + 1) * (degree + 1);
}

std::vector<Vector2d> lattice(Shape shape, int n) {
  std::vector<Vector2d> points;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= (shape == Shape::triangle ? n - j : n); ++i)
      points.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n);
  return points;
}

bool holds(Shape shape, const Vector2d& xi, double tolerance) {
  const double farthest = shape == Shape::triangle ? xi.sum() : xi.maxCoeff();
  return xi.minCoeff() >= -tolerance && farthest <= 1 + tolerance;
}

Vector2d put_inside(Shape shape, const Vector2d& xi) {
  Vector2d inside = xi.cwiseMax(0.0).cwiseMin(1.0);
  if (shape == Shape::triangle && inside.sum() > 1) inside /= inside.sum();
  return inside;
}

std::array<int, 2> side_corners(Shape shape, int side) {
  if (shape == Shape::triangle) return {side, (side + 1) % 3};
  return square_sides[side];
}

std::array<int, 2> anticlockwise_corners(Shape shape, int side) {
  const auto [from, to] = side_corners(shape, side);
  if (runs_clockwise(shape, side)) return {to, from};
  return {from, to};
}

std::vector<int> side_nodes(Shape shape, int degree, int side) {
  // Row j of the triangle follows rows of degree + 1, degree, ... nodes.
  const auto index = [&](int i, int j) {
    return shape == Shape::triangle ? j * (degree + 1) - j * (j - 1) / 2 + i : j * (degree + 1) + i;
  };
  const auto from = corner(shape, side_corners(shape, side)[0]), to = corner(shape, side_corners(shape, side)[1]);
  std::vector<int> nodes;
  for (int n = 0; n <= degree; ++n) {
    const Vector2d place = (degree - n) * from + n * to;
    nodes.push_back(index(static_cast<int>(place[0]), static_cast<int>(place[1])));
  }
  return nodes;
}

Vector2d side_point(Shape shape, int side, double t) {
  const auto [from, to] = side_corners(shape, side);
  return (1 - t) * corner(shape, from) + t * corner(shape, to);
}

Vector2d side_tangent(Shape shape, int side) {
  const auto [from, to] = side_corners(shape, side);
  return (runs_clockwise(shape, side) ? -1 : 1) * (corner(shape, to) - corner(shape, from));
}

}  // namespace plastron::mesh
