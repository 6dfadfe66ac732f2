// Plane geometry of the built-in domains: whether a polygon is simple, whether a point is inside.
#include <plastron/config/sections.hpp>

#include <Eigen/Geometry>

#include <cmath>

namespace plastron::config {

namespace {

using Eigen::Vector2d;

// Points on the boundary are inside up to this multiple of the domain's size.
constexpr double slack = 1e-9;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

bool segments_meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const bool cross_ab = cross(b - a, c - a) * cross(b - a, d - a) < 0;
  const bool cross_cd = cross(d - c, a - c) * cross(d - c, b - c) < 0;
  if (cross_ab && cross_cd) return true;
  const double touching = 1e-12 * ((b - a).norm() + (d - c).norm());
  return std::min({distance_to_segment(c, a, b), distance_to_segment(d, a, b), distance_to_segment(a, c, d),
                   distance_to_segment(b, c, d)}) <= touching;
}

// Neighbouring sides share a corner. They overlap if the second reverses along the first.
bool folds_back(const Vector2d& before, const Vector2d& corner, const Vector2d& after) {
  const Vector2d in = corner - before, out = after - corner;
  return std::abs(cross(in, out)) <= 1e-12 * in.norm() * out.norm() && in.dot(out) < 0;
}

struct MayContain {
  const Vector2d& p;

  bool operator()(const domain::Rectangle& r) const {
    const double margin = slack * (r.to - r.from).norm();
    return ((p - r.from).array() >= -margin).all() && ((r.to - p).array() >= -margin).all();
  }
  bool operator()(const domain::Disk& d) const { return (p - d.centre).norm() <= d.radius * (1 + slack); }
  bool operator()(const domain::Annulus& a) const {
    const double radius = (p - a.centre).norm();
    return radius >= a.inner * (1 - slack) && radius <= a.outer * (1 + slack);
  }
  bool operator()(const domain::Polygon& polygon) const {
    const auto& c = polygon.corners;
    bool inside = false;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vector2d &a = c[i], &b = c[(i + 1) % c.size()];
      if (distance_to_segment(p, a, b) <= slack * (b - a).norm()) return true;
      if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]))
        inside = !inside;
    }
    return inside;
  }
  bool operator()(const domain::MeshFile&) const { return true; }
};

/// The points of a domain in words.
struct Extent {
  std::string operator()(const domain::Rectangle& r) const { return box(r.from, r.to); }
  std::string operator()(const domain::Disk& d) const {
    return fmt::format("at most {:.6g} from ({:.6g}, {:.6g})", d.radius, d.centre[0], d.centre[1]);
  }
  std::string operator()(const domain::Annulus& a) const {
    return fmt::format("{:.6g} to {:.6g} from ({:.6g}, {:.6g})", a.inner, a.outer, a.centre[0], a.centre[1]);
  }
  std::string operator()(const domain::Polygon& polygon) const {
    Eigen::AlignedBox2d around;
    for (const Vector2d& corner : polygon.corners) around.extend(corner);
    return "inside of the polygon, which has " + box(around.min(), around.max());
  }
  std::string operator()(const domain::MeshFile&) const { return ""; }

 private:
  static std::string box(const Vector2d& low, const Vector2d& high) {
    return fmt::format("{:.6g} <= x <= {:.6g}, {:.6g} <= y <= {:.6g}", low[0], high[0], low[1], high[1]);
  }
};

}  // namespace

std::string polygon_fault(const std::vector<Vector2d>& corners) {
  const std::size_t n = corners.size();
  if (n < 3) return fmt::format("a polygon of {} corners has no area", n);
  const auto corner = [&](std::size_t i) -> const Vector2d& { return corners[i % n]; };
  for (std::size_t i = 0; i < n; ++i)
    if (corner(i) == corner(i + 1)) return fmt::format("corners {} and {} are the same point", i + 1, (i + 1) % n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    if (folds_back(corner(i), corner(i + 1), corner(i + 2)))
      return fmt::format("edge{} and edge{} of the polygon lie on each other", i + 1, (i + 1) % n + 1);
    for (std::size_t j = i + 2; j < n; ++j)
      if (!(i == 0 && j == n - 1) && segments_meet(corner(i), corner(i + 1), corner(j), corner(j + 1)))
        return fmt::format("edge{} and edge{} of the polygon cross", i + 1, j + 1);
  }
  return "";
}

bool check_inside(const Table& table, const std::string& name, const std::string& what, const ShellPlace& place) {
  const auto& domain = table.reading().domain;
  if (is_in_space(place) || !domain || std::visit(MayContain{place.head<2>()}, *domain)) return true;
  table.report(name, fmt::format("{} ({:g}, {:g}) lies outside of the domain", what, place[0], place[1]),
               std::visit(Extent{}, *domain), "two numbers are parameters x, y; a place in space is [X, Y, Z]");
  return false;
}

}  // namespace plastron::config
