// The only file that includes CGAL, which compiles slowly.
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/triangle_features.hpp>
#include <plastron/obstacle/triangle_surface.hpp>
#include <plastron/obstacle/triangle_tree.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace plastron::obstacle {

namespace {

/// Kernel with exact predicates, which decide exactly whether triangles cross.
using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;

Exact::Point_3 exact(const Vector3d& p) { return {p[0], p[1], p[2]}; }

/// Whether two triangles cross. With a common side they cross if they fold onto each other. With a common corner they
/// cross if the opposite side of one meets the other. All others cross if they meet.
bool cross_each_other(const TriangleMesh& mesh, const std::array<int, 3>& s, const std::array<int, 3>& t) {
  const auto point = [&](int i) { return exact(mesh.points[i]); };
  const auto triangle = [&](const std::array<int, 3>& c) {
    return Exact::Triangle_3(point(c[0]), point(c[1]), point(c[2]));
  };
  std::vector<int> shared, own_s, own_t;
  for (const int i : s) (std::ranges::count(t, i) ? shared : own_s).push_back(i);
  for (const int i : t)
    if (std::ranges::count(s, i) == 0) own_t.push_back(i);
  if (shared.size() == 3) return true;
  if (shared.size() == 2)
    return CGAL::coplanar(point(shared[0]), point(shared[1]), point(own_s[0]), point(own_t[0])) &&
           CGAL::coplanar_orientation(point(shared[0]), point(shared[1]), point(own_s[0]), point(own_t[0])) ==
               CGAL::POSITIVE;
  if (shared.size() == 1)
    return CGAL::do_intersect(triangle(s), Exact::Segment_3(point(own_t[0]), point(own_t[1]))) ||
           CGAL::do_intersect(triangle(t), Exact::Segment_3(point(own_s[0]), point(own_s[1])));
  return CGAL::do_intersect(triangle(s), triangle(t));
}

struct Crossing {
  std::size_t first, second;
};

void check_crossings(const TriangleMesh& mesh, const std::string& name) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Box> boxes;
  boxes.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& c = mesh.triangles[i];
    boxes.emplace_back(
        exact(mesh.points[c[0]]).bbox() + exact(mesh.points[c[1]]).bbox() + exact(mesh.points[c[2]]).bbox(), i);
  }
  const auto look = [&](const Box& a, const Box& b) {
    if (cross_each_other(mesh, mesh.triangles[a.info()], mesh.triangles[b.info()])) throw Crossing{a.info(), b.info()};
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), look);
  } catch (const Crossing& found) {
    const Vector3d& at = mesh.points[mesh.triangles[found.first][0]];
    throw ObstacleError(fmt::format(
        "{}: the surface cuts itself: triangles {} and {} cross near ({:.6g}, {:.6g}, {:.6g}); repair it, or "
        "give its parts as obstacles of their own",
        name, std::min(found.first, found.second) + 1, std::max(found.first, found.second) + 1, at[0], at[1], at[2]));
  }
}

TriangleMesh checked(TriangleMesh mesh, const std::string& name) {
  check_closed(mesh, name);
  check_crossings(mesh, name);
  return mesh;
}

}  // namespace

struct TriangleSurface::Tree {
  TriangleMesh mesh;
  TriangleFeatures features;
  TriangleTree boxes;

  explicit Tree(TriangleMesh given) : mesh(std::move(given)), features(mesh), boxes(mesh, features.faces()) {}
};

TriangleSurface::TriangleSurface(TriangleMesh mesh, const std::string& name)
    : tree_(std::make_shared<const Tree>(checked(std::move(mesh), name))) {}

Nearest TriangleSurface::nearest(const Vector3d& X) const {
  const int triangle = tree_->boxes.nearest(tree_->mesh, tree_->features.faces(), X);
  return tree_->features.nearest(tree_->mesh, triangle, X);
}

std::optional<Extent> TriangleSurface::extent() const {
  Vector3d low = mesh().points.front(), high = low;
  for (const Vector3d& p : mesh().points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vector3d middle = (low + high) / 2, half = extent_margin / 2 * (high - low);
  return Extent{middle - half, middle + half};
}

const TriangleMesh& TriangleSurface::mesh() const { return tree_->mesh; }

}  // namespace plastron::obstacle
