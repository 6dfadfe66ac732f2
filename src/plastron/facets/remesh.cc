// The only file of this folder that includes CGAL, which compiles slowly.
#include <plastron/facets/remesh.hpp>

#include <plastron/geometry/file_error.hpp>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>

namespace plastron::facets {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

Point to_cgal(const Vector3d& p) { return {p[0], p[1], p[2]}; }
Vector3d from_cgal(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// Triangles of CGAL with what the remeshing must keep.
struct Surface {
  Mesh mesh{};
  Mesh::Property_map<Mesh::Face_index, int> face_of{};
  Mesh::Property_map<Mesh::Edge_index, bool> is_line{};
  Mesh::Property_map<Mesh::Vertex_index, bool> is_corner{};
};

/// Makes the surface. Parts that touch in a point only get a point each.
Surface surface_of(const Facets& facets) {
  std::vector<Point> points;
  for (const Vector3d& p : facets.mesh.points) points.push_back(to_cgal(p));
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& [a, b, c] : facets.mesh.triangles)
    triangles.push_back({std::size_t(a), std::size_t(b), std::size_t(c)});
  const std::size_t count = points.size();
  processing::orient_polygon_soup(points, triangles);
  Surface surface;
  processing::polygon_soup_to_polygon_mesh(points, triangles, surface.mesh);
  surface.face_of = surface.mesh.add_property_map<Mesh::Face_index, int>("f:face", 0).first;
  surface.is_line = surface.mesh.add_property_map<Mesh::Edge_index, bool>("e:line", false).first;
  surface.is_corner = surface.mesh.add_property_map<Mesh::Vertex_index, bool>("v:corner", false).first;
  for (const Mesh::Face_index f : surface.mesh.faces()) surface.face_of[f] = facets.face_of[f];
  std::set<std::array<int, 2>> lines;
  for (const FacetCurve& curve : facets.curves)
    for (const auto& [a, b] : curve.sides) lines.insert({std::min(a, b), std::max(a, b)});
  for (const Mesh::Edge_index e : surface.mesh.edges()) {
    const int a = static_cast<int>(surface.mesh.vertex(e, 0)), b = static_cast<int>(surface.mesh.vertex(e, 1));
    surface.is_line[e] = surface.mesh.is_border(e) || lines.contains({std::min(a, b), std::max(a, b)});
  }
  for (const int corner : facets.corners) surface.is_corner[Mesh::Vertex_index(std::uint32_t(corner))] = true;
  for (std::size_t twin = count; twin < points.size(); ++twin)
    surface.is_corner[Mesh::Vertex_index(std::uint32_t(twin))] = true;
  return surface;
}

Vector3d nearest_on(const Vector3d& a, const Vector3d& b, const Vector3d& point) {
  const Vector3d along = b - a;
  return a + std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

struct Foot {
  Vector3d at{};
  double distance = std::numeric_limits<double>::infinity();
  std::size_t side = 0;
};

/// The point of a curve that is nearest to a point.
Foot foot_on(const Facets& facets, const FacetCurve& curve, const Vector3d& point) {
  Foot foot;
  for (std::size_t i = 0; i < curve.sides.size(); ++i) {
    const auto& [a, b] = curve.sides[i];
    const Vector3d at = nearest_on(facets.mesh.points[a], facets.mesh.points[b], point);
    if (const double distance = (at - point).norm(); distance < foot.distance) foot = {at, distance, i};
  }
  return foot;
}

/// Finds the curve of a side of the new triangles among those between the same faces.
class CurveSearch {
 public:
  explicit CurveSearch(const Facets& facets) : facets_(facets) {
    std::map<std::array<int, 2>, std::vector<int>> faces_at;
    const auto key = [](int a, int b) { return std::array{std::min(a, b), std::max(a, b)}; };
    for (const geometry::TriangleSide& side : geometry::sorted_sides(facets.mesh))
      faces_at[{side.low, side.high}].push_back(facets.face_of[side.triangle]);
    for (std::size_t c = 0; c < facets.curves.size(); ++c) {
      const auto& [a, b] = facets.curves[c].sides.front();
      const auto& faces = faces_at.at(key(a, b));
      curves_[faces.size() == 1 ? std::array{-1, faces[0]} : key(faces[0], faces[1])].push_back(static_cast<int>(c));
    }
  }

  /// Returns the side with its ends in the direction of the curve.
  Remeshed::Line line(std::array<int, 2> ends, const std::array<int, 2>& faces,
                      const std::vector<Vector3d>& points) const {
    const Vector3d along = points[ends[1]] - points[ends[0]], middle = points[ends[0]] + along / 2;
    Foot best;
    int curve = 0;
    for (const int c : curves_.at(faces))
      if (const Foot foot = foot_on(facets_, facets_.curves[c], middle); foot.distance < best.distance)
        best = foot, curve = c;
    const auto& [a, b] = facets_.curves[curve].sides[best.side];
    if ((facets_.mesh.points[b] - facets_.mesh.points[a]).dot(along) < 0) std::swap(ends[0], ends[1]);
    return {ends, curve};
  }

 private:
  const Facets& facets_;
  std::map<std::array<int, 2>, std::vector<int>> curves_{};  ///< by the two faces, ascending; -1 beyond a border
};

Remeshed result_of(const Surface& surface, const Facets& facets) {
  const Mesh& mesh = surface.mesh;
  Remeshed result;
  for (const Mesh::Vertex_index v : mesh.vertices()) result.points.push_back(from_cgal(mesh.point(v)));
  for (const Mesh::Face_index f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    result.triangles.push_back({static_cast<int>(mesh.source(h)), static_cast<int>(mesh.target(h)),
                                static_cast<int>(mesh.target(mesh.next(h)))});
    result.face_of.push_back(surface.face_of[f]);
  }
  const CurveSearch search(facets);
  for (const Mesh::Edge_index e : mesh.edges()) {
    if (!surface.is_line[e]) continue;
    const auto face = [&](int k) {
      const auto h = mesh.halfedge(e, k);
      return mesh.is_border(h) ? -1 : surface.face_of[mesh.face(h)];
    };
    result.lines.push_back(search.line({static_cast<int>(mesh.vertex(e, 0)), static_cast<int>(mesh.vertex(e, 1))},
                                       {std::min(face(0), face(1)), std::max(face(0), face(1))}, result.points));
  }
  return result;
}

}  // namespace

Remeshed remesh(const Facets& facets, double length, const std::string& name) {
  try {
    Surface surface = surface_of(facets);
    constexpr unsigned rounds = 10, relaxations = 3;
    constexpr double shorter = 1.1;  // the sides become shorter than the length that is asked for
    processing::isotropic_remeshing(surface.mesh.faces(), shorter * length, surface.mesh,
                                    CGAL::parameters::number_of_iterations(rounds)
                                        .number_of_relaxation_steps(relaxations)
                                        .edge_is_constrained_map(surface.is_line)
                                        .vertex_is_constrained_map(surface.is_corner)
                                        .face_patch_map(surface.face_of));
    surface.mesh.collect_garbage();
    return result_of(surface, facets);
  } catch (const std::exception& error) {
    throw geometry::FileError(fmt::format(
        "{}: its facets cannot be meshed with sides of {:.3g} m ({}); take another size, or repair the surface", name,
        length, error.what()));
  }
}

Remeshed as_they_are(const Facets& facets) {
  Remeshed mesh{.points = facets.mesh.points, .triangles = facets.mesh.triangles, .face_of = facets.face_of};
  for (std::size_t c = 0; c < facets.curves.size(); ++c)
    for (const std::array<int, 2>& side : facets.curves[c].sides) mesh.lines.push_back({side, static_cast<int>(c)});
  return mesh;
}

using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;

struct FacetProjection::Tree {
  Mesh mesh{};
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree{};
};

FacetProjection::FacetProjection(const Facets& facets) : facets_(facets), tree_(std::make_unique<Tree>()) {
  tree_->mesh = surface_of(facets).mesh;
  tree_->tree.insert(faces(tree_->mesh).begin(), faces(tree_->mesh).end(), tree_->mesh);
  tree_->tree.accelerate_distance_queries();
}

FacetProjection::~FacetProjection() = default;

Vector3d FacetProjection::on_facets(const Vector3d& point) const {
  return from_cgal(tree_->tree.closest_point(to_cgal(point)));
}

Vector3d FacetProjection::on_curve(const Vector3d& point, int curve) const {
  return foot_on(facets_, facets_.curves[curve], point).at;
}

}  // namespace plastron::facets
