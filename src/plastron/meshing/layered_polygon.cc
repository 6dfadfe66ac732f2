// Polygons with rows along their sides. Four convex corners make a grid of straight lines. For other polygons the
// rows are cut off first and Gmsh meshes the rest.
#include <plastron/domain/domain.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/cut_mesh.hpp>
#include <plastron/meshing/constants.hpp>
#include <plastron/meshing/layered_mesh.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace plastron::meshing {

namespace {

using Eigen::Vector2d;

/// A side of a polygon, with the interior on its left.
struct Line {
  Vector2d from, to;
  Vector2d direction() const { return (to - from).normalized(); }
  Line shifted(double inwards) const {
    const Vector2d n = inwards * Vector2d(-direction()[1], direction()[0]);
    return {from + n, to + n};
  }
};

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

Vector2d crossing(const Line& a, const Line& b) {
  const Vector2d u = a.to - a.from, v = b.to - b.from;
  return a.from + cross(b.from - a.from, v) / cross(u, v) * u;
}

[[noreturn]] void refuse_rows() { throw mesh::DomainError("rows along the sides of the polygon do not fit into it"); }

/// The lines of a grid from one side of a convex quadrilateral to the opposite one.
std::vector<Line> lines_between(const Line& first, const std::vector<double>& near, const Line& last,
                                const std::vector<double>& far) {
  std::vector<Line> lines{first};
  for (const double d : near) lines.push_back(first.shifted(d));
  std::transform(far.rbegin(), far.rend(), std::back_inserter(lines), [&](double d) { return last.shifted(d); });
  lines.push_back(last);
  return lines;
}

std::vector<int> parts_between(std::size_t near, std::size_t far, int inner) {
  std::vector<int> parts(near + far + 1, 1);
  parts[near] = inner;
  return parts;
}

mesh::CoarseMesh grid_of_four_sides(const std::vector<Line>& sides, const std::vector<int>& boundaries,
                                    const std::vector<std::string>& names, const Rows& rows) {
  const auto distances = [&](std::size_t k) -> const std::vector<double>& { return rows.distances[boundaries[k]][0]; };
  // Side 0 is the bottom; right, top and left follow anticlockwise.
  const auto across = lines_between(sides[3], distances(3), sides[1], distances(1));
  const auto upwards = lines_between(sides[0], distances(0), sides[2], distances(2));
  std::vector<Vector2d> vertices;
  for (const Line& up : upwards)
    for (const Line& x : across) vertices.push_back(crossing(up, x));
  const std::size_t columns = across.size() - 1;
  mesh::CoarseMesh mesh = domain::grid_mesh(std::move(vertices), columns);
  mesh.boundaries = names;
  const std::array of_grid{boundaries[3], boundaries[1], boundaries[0], boundaries[2]};
  for (mesh::BoundaryEdge& edge : mesh.edges) edge.boundary = of_grid[edge.boundary];
  const auto x_parts = parts_between(distances(3).size(), distances(1).size(), rows.inner[0]);
  const auto y_parts = parts_between(distances(0).size(), distances(2).size(), rows.inner[1]);
  std::vector<std::array<int, 2>> parts;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) parts.push_back({x_parts[c % columns], y_parts[c / columns]});
  return fem::subdivided(mesh, parts);
}

/// The corner between a side and the next, with the rows that meet there.
struct Corner {
  Vector2d outer;  ///< corner of the polygon
  Vector2d inner;  ///< intersection of the rows' lines
  /// True if the rows cross in a parallelogram; else the line from `outer` to `inner` separates them.
  bool has_cell = false;
  Vector2d before, after;  ///< points where the rows' lines meet the sides; `outer` without a cell
};

Corner corner_between(const Line& a, double depth_a, const Line& b, double depth_b) {
  const Line row_a = a.shifted(depth_a), row_b = b.shifted(depth_b);
  const double sine = cross(a.direction(), b.direction());
  if (std::abs(sine) < constants.straight_sine) {  // the side continues, possibly with another depth
    const Vector2d n(-a.direction()[1], a.direction()[0]);
    return {.outer = a.to, .inner = a.to + std::min(depth_a, depth_b) * n, .before = a.to, .after = a.to};
  }
  Corner corner{.outer = a.to, .inner = crossing(row_a, row_b), .before = a.to, .after = a.to};
  corner.has_cell = sine > constants.cell_corner_sine;  // nearly square
  if (corner.has_cell) {
    corner.before = crossing(a, row_b);
    corner.after = crossing(b, row_a);
  }
  return corner;
}

/// The rows around the mesh made by Gmsh.
class Surrounded {
 public:
  Surrounded(mesh::CoarseMesh inside, std::vector<std::string> names) : mesh_(std::move(inside)) {
    inner_edges_ = std::exchange(mesh_.edges, {});
    mesh_.boundaries = std::move(names);
  }

  void add_corner(const Corner& corner, int side, int next) {
    const int inner = nearest(corner.inner);
    ends_.push_back({add_vertex(corner.outer), 0});
    Ends& ends = ends_.back();
    ends.next = ends.previous;
    if (!corner.has_cell) return;
    const int outer = ends.previous;
    ends = {add_vertex(corner.before), add_vertex(corner.after)};
    add_cell({outer, ends.next, ends.previous, inner});
    mesh_.edges.push_back({{ends.previous, outer}, side});
    mesh_.edges.push_back({{outer, ends.next}, next});
  }

  /// Adds the row along side i of the inner polygon, between the corners at the side's beginning and end.
  void add_row(int side, int boundary, std::size_t first_corner, std::size_t last_corner) {
    const int begin = ends_[first_corner].next, end = ends_[last_corner].previous;
    std::vector<int> inner;
    for (const mesh::BoundaryEdge& edge : inner_edges_)
      if (edge.boundary == side) inner.insert(inner.end(), edge.vertices.begin(), edge.vertices.end());
    const Vector2d along = at(end) - at(begin);
    std::ranges::sort(inner, {}, [&](int v) { return at(v).dot(along); });
    inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
    const Vector2d first = at(inner.front()), last = at(inner.back());
    int outer = begin;
    for (std::size_t k = 1; k < inner.size(); ++k) {
      const double t = (at(inner[k]) - first).norm() / (last - first).norm();
      const int next = k + 1 == inner.size() ? end : add_vertex(at(begin) + t * along);
      add_cell({outer, next, inner[k - 1], inner[k]});
      mesh_.edges.push_back({{outer, next}, boundary});
      outer = next;
    }
  }

  mesh::CoarseMesh finished() { return std::move(mesh_); }

 private:
  struct Ends {
    int previous, next;  ///< end of the previous side's row, and beginning of the next side's row
  };

  const Vector2d& at(int vertex) const { return mesh_.vertices[vertex]; }
  int add_vertex(const Vector2d& x) {
    mesh_.vertices.push_back(x);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }
  int nearest(const Vector2d& x) const {
    const auto found =
        std::ranges::min_element(mesh_.vertices, {}, [&](const Vector2d& v) { return (v - x).squaredNorm(); });
    return static_cast<int>(found - mesh_.vertices.begin());
  }
  void add_cell(const std::array<int, 4>& v) {
    const mesh::LagrangeMap map{1, {at(v[0]), at(v[1]), at(v[2]), at(v[3])}};
    for (const int k : {0, 1, 2, 3}) {
      const Vector2d p = mesh::corner(mesh::Shape::quadrilateral, k);
      const geometry::PlaneJet jet = map(p);
      if (!(cross(jet.d[0], jet.d[1]) > 0)) refuse_rows();
    }
    mesh_.cells.push_back({v, 0, {map}});
  }

  mesh::CoarseMesh mesh_;
  std::vector<mesh::BoundaryEdge> inner_edges_;
  std::vector<Ends> ends_;
};

/// Depths of each side's rows, at their last lines; sides without rows get the largest depth of the others.
std::vector<double> depths_of(const std::vector<int>& boundaries, const Rows& rows) {
  double deepest = 0;
  for (const auto& regions : rows.distances)
    if (!regions[0].empty()) deepest = std::max(deepest, regions[0].back());
  std::vector<double> depths;
  for (const int b : boundaries) {
    const auto& distances = rows.distances[b][0];
    depths.push_back(distances.empty() ? deepest : distances.back());
  }
  return depths;
}

mesh::CoarseMesh surrounded_by_rows(const std::vector<Line>& sides, const std::vector<int>& boundaries,
                                    const std::vector<std::string>& names, const std::vector<double>& depths,
                                    double length) {
  const std::size_t n = sides.size();
  std::vector<Corner> corners;  // corners at the end of each side
  domain::Polygon inner;        // its side i is the last line of the row at side i
  for (std::size_t i = 0; i < n; ++i)
    corners.push_back(corner_between(sides[i], depths[i], sides[(i + 1) % n], depths[(i + 1) % n]));
  for (std::size_t i = 0; i < n; ++i) inner.corners.push_back(corners[(i + n - 1) % n].inner);
  for (std::size_t i = 0; i < n; ++i)
    if (!((inner.corners[(i + 1) % n] - inner.corners[i]).dot(sides[i].direction()) > 0)) refuse_rows();
  Surrounded mesh(domain::gmsh_polygon(inner, mesh::Shape::quadrilateral, length), names);
  for (std::size_t i = 0; i < n; ++i) mesh.add_corner(corners[i], boundaries[i], boundaries[(i + 1) % n]);
  for (std::size_t i = 0; i < n; ++i) mesh.add_row(static_cast<int>(i), boundaries[i], (i + n - 1) % n, i);
  mesh::CoarseMesh result = mesh.finished();
  if (mesh::find_overlap(result)) refuse_rows();
  return result;
}

}  // namespace

mesh::CoarseMesh layered_polygon(const domain::Polygon& polygon, const Rows& rows) {
  const auto names = domain::boundary_names(domain::Domain{polygon});
  const auto& p = polygon.corners;
  const std::size_t n = p.size();
  std::vector<Line> sides;
  std::vector<int> boundaries;
  for (std::size_t i = 0; i < n; ++i) {
    sides.push_back({p[i], p[(i + 1) % n]});
    boundaries.push_back(static_cast<int>(i));
  }
  if (domain::signed_area(polygon) < 0) {
    for (Line& side : sides) std::swap(side.from, side.to);
    std::ranges::reverse(sides);
    std::ranges::reverse(boundaries);
  }
  if (domain::is_convex_quadrilateral(polygon)) {
    mesh::CoarseMesh mesh = grid_of_four_sides(sides, boundaries, names, rows);
    if (mesh::find_overlap(mesh)) refuse_rows();
    return mesh;
  }
  const std::vector<double> depths = depths_of(boundaries, rows);
  const double length = domain::perimeter(polygon) / std::max(constants.least_cells_around, rows.inner[0]);
  if (std::ranges::max(depths) == 0) return domain::gmsh_polygon(polygon, mesh::Shape::quadrilateral, length);
  return surrounded_by_rows(sides, boundaries, names, depths, length);
}

}  // namespace plastron::meshing
