#include "quads.hpp"

#include "edge_curve.hpp"

#include <plastron/domain/gmsh_session.hpp>
#include <plastron/facets/triangle_pairs.hpp>

#include <TopoDS.hxx>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace plastron::cad {

namespace {

/// Numbers of the edges that are curves of Gmsh. Both number the shapes in the order in which they find them; that an
/// edge is where its curve is, is checked.
class CurveEdges {
 public:
  explicit CurveEdges(const JoinedPart& part, double tolerance) : part_(part), tolerance_(tolerance) {}

  int edge_of(int curve) {
    const Vector3d middle = middle_of(curve);
    const auto is_same = [&](int edge) {
      if (edge < 1 || edge > part_.edges.Extent()) return false;
      const TopoDS_Edge shape = TopoDS::Edge(part_.edges(edge));
      if (BRep_Tool::Degenerated(shape)) return false;
      const BRepAdaptor_Curve adaptor(shape);
      const double t = (adaptor.FirstParameter() + adaptor.LastParameter()) / 2;
      return (vector_of(adaptor.Value(t)) - middle).norm() <= tolerance_;
    };
    if (is_same(curve)) return curve;
    for (int edge = 1; edge <= part_.edges.Extent(); ++edge)
      if (is_same(edge)) return edge;
    throw PartError(fmt::format("an edge at ({:.6g}, {:.6g}, {:.6g}) mm is lost when its faces are meshed", middle[0],
                                middle[1], middle[2]));
  }

 private:
  static Vector3d middle_of(int curve) {
    std::vector<double> low, high, point;
    gmsh::model::getParametrizationBounds(1, curve, low, high);
    gmsh::model::getValue(1, curve, {(low[0] + high[0]) / 2}, point);
    return {point[0], point[1], point[2]};
  }

  const JoinedPart& part_;
  double tolerance_;
};

/// Number of the face that is a surface of Gmsh, by order, checked by the area.
int face_of(const JoinedPart& part, int surface) {
  double area = 0;
  gmsh::model::occ::getMass(2, surface, area);
  constexpr double same = 1e-6;
  const auto is_same = [&](int face) {
    return face >= 1 && face <= part.faces.Extent() && std::abs(area_of(part.faces(face)) - area) <= same * area;
  };
  if (is_same(surface)) return surface;
  throw PartError(fmt::format("face {} is lost when it is meshed", surface));
}

/// Triangles on the faces, and their sides on edges.
struct Triangles {
  std::vector<Vector3d> points{};
  std::vector<std::array<int, 3>> corners{};
  std::vector<int> face_of{};
  std::vector<Quads::Line> lines{};
};

/// Calls visit(nodes) for each element of an entity, which has elements with `count` nodes only.
template <class Visit>
void for_each_element(int dimension, int entity, std::size_t count, const Visit& visit) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  for (const auto& of_type : nodes)
    for (std::size_t i = 0; i + count <= of_type.size(); i += count) visit(&of_type[i]);
}

Triangles triangles_in_gmsh(const JoinedPart& part, double tolerance) {
  Triangles mesh;
  std::map<std::size_t, int> number;
  std::vector<std::size_t> tags;
  std::vector<double> x, parametric;
  gmsh::model::mesh::getNodes(tags, x, parametric);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    number[tags[i]] = static_cast<int>(i);
    mesh.points.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  }
  CurveEdges edges(part, tolerance);
  gmsh::vectorpair curves, surfaces;
  gmsh::model::getEntities(curves, 1);
  for (const auto& entity : curves) {
    const int curve = entity.second;
    int edge = 0;
    for_each_element(1, curve, 2, [&](const std::size_t* n) {
      if (edge == 0) edge = edges.edge_of(curve);
      mesh.lines.push_back({{number[n[0]], number[n[1]]}, edge});
    });
  }
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dimension, surface] : surfaces) {
    const int face = face_of(part, surface);
    const std::size_t before = mesh.corners.size();
    for_each_element(2, surface, 3, [&](const std::size_t* n) {
      mesh.corners.push_back({number[n[0]], number[n[1]], number[n[2]]});
      mesh.face_of.push_back(face);
    });
    if (mesh.corners.size() == before)
      throw PartError(fmt::format("Gmsh makes no cells on face {}", part.labelled[face - 1].number));
  }
  return mesh;
}

/// Divides triangles into quadrilaterals: pairs of triangles into four, others into three. Where the outline of a face runs on
/// straight, a cell must not have a corner there with both sides on the outline: its angle would be 180 degrees.
class QuadMaker {
 public:
  QuadMaker(const JoinedPart& part, Triangles mesh) : mesh_(std::move(mesh)) {
    for (const Quads::Line& line : mesh_.lines) {
      if (!curves_.contains(line.edge)) curves_.emplace(line.edge, EdgeCurve(TopoDS::Edge(part.edges(line.edge))));
      edge_at_[ascending(line.ends[0], line.ends[1])] = line.edge;
    }
  }

  Quads make() {
    divide_ears();
    std::vector<bool> is_used(mesh_.corners.size(), false);
    const auto pairs = facets::triangle_pairs(
        mesh_.points, mesh_.corners, [&](const Ends& ends) { return edge_at_.contains(ends); },
        [&](const std::array<int, 4>& corners) {
          for (std::size_t k = 0; k < 4; ++k)
            if (is_straight_on(corners[(k + 3) % 4], corners[k], corners[(k + 1) % 4])) return false;
          return true;
        });
    quads_.points = mesh_.points;
    for (const facets::TrianglePair& pair : pairs) {
      is_used[pair.triangles[0]] = is_used[pair.triangles[1]] = true;
      divide({pair.corners.begin(), pair.corners.end()}, mesh_.face_of[pair.triangles[0]]);
    }
    for (std::size_t t = 0; t < mesh_.corners.size(); ++t)
      if (!is_used[t]) divide({mesh_.corners[t].begin(), mesh_.corners[t].end()}, mesh_.face_of[t]);
    for (const Quads::Line& line : mesh_.lines) {
      const int centre = middle(line.ends[0], line.ends[1]);
      quads_.lines.push_back({{line.ends[0], centre}, line.edge});
      quads_.lines.push_back({{centre, line.ends[1]}, line.edge});
    }
    return std::move(quads_);
  }

 private:
  using Ends = facets::Ends;
  static Ends ascending(int a, int b) { return facets::ascending(a, b); }

  /// Whether a-b and b-c are pieces of edges that continue each other at b.
  bool is_straight_on(int a, int b, int c) const {
    const auto first = edge_at_.find(ascending(a, b)), second = edge_at_.find(ascending(b, c));
    if (first == edge_at_.end() || second == edge_at_.end()) return false;
    constexpr double straight = -0.9;  // 154 degrees
    const auto& p = mesh_.points;
    return curves_.at(first->second).direction(p[b], p[a]).dot(curves_.at(second->second).direction(p[b], p[c])) <
           straight;
  }

  /// Gives triangles whose corner is such a place a neighbour there: their third side is divided.
  void divide_ears() {
    std::map<Ends, std::vector<std::size_t>> at_side;
    for (std::size_t t = 0; t < mesh_.corners.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        at_side[ascending(mesh_.corners[t][k], mesh_.corners[t][(k + 1) % 3])].push_back(t);
    std::vector<bool> is_divided(mesh_.corners.size(), false);
    const std::size_t count = mesh_.corners.size();
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t k = 0; k < 3 && !is_divided[t]; ++k) {
        const std::array<int, 3> corners = mesh_.corners[t];
        const int v = corners[k], a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        if (!is_straight_on(b, v, a)) continue;
        const auto& both = at_side.at(ascending(a, b));
        const bool is_inside = both.size() == 2 && !edge_at_.contains(ascending(a, b));
        const std::size_t other = is_inside ? (both[0] == t ? both[1] : both[0]) : t;
        is_divided[t] = true;
        if (is_inside && !is_divided[other]) {
          is_divided[other] = true;
          divide_side(t, other, a, b);
        } else {
          divide_at_centre(t);
        }
      }
  }

  void divide_side(std::size_t t, std::size_t other, int a, int b) {
    const int middle = add_point((mesh_.points[a] + mesh_.points[b]) / 2);
    for (const std::size_t triangle : {t, other}) {
      const std::array<int, 3> corners = mesh_.corners[triangle];
      std::array<int, 3> first = corners, second = corners;
      std::ranges::replace(first, b, middle);
      std::ranges::replace(second, a, middle);
      mesh_.corners[triangle] = first;
      add_triangle(second, triangle);
    }
  }

  void divide_at_centre(std::size_t t) {
    const std::array<int, 3> c = mesh_.corners[t];
    const int centre = add_point((mesh_.points[c[0]] + mesh_.points[c[1]] + mesh_.points[c[2]]) / 3);
    mesh_.corners[t] = {c[0], c[1], centre};
    add_triangle({c[1], c[2], centre}, t);
    add_triangle({c[2], c[0], centre}, t);
  }

  int add_point(const Vector3d& point) {
    mesh_.points.push_back(point);
    return static_cast<int>(mesh_.points.size()) - 1;
  }
  void add_triangle(const std::array<int, 3>& corners, std::size_t like) {
    mesh_.corners.push_back(corners);
    mesh_.face_of.push_back(mesh_.face_of[like]);
  }

  /// Adds a cell for each corner of a polygon: the corner, the middles of its sides, and the polygon's middle.
  void divide(const std::vector<int>& corners, int face) {
    Vector3d mean = Vector3d::Zero();
    for (const int corner : corners) mean += quads_.points[corner] / static_cast<double>(corners.size());
    const int centre = static_cast<int>(quads_.points.size());
    quads_.points.push_back(mean);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int last = corners[(k + corners.size() - 1) % corners.size()], next = corners[(k + 1) % corners.size()];
      quads_.cells.push_back({{corners[k], middle(corners[k], next), centre, middle(last, corners[k])}, face});
    }
  }

  /// The middle of a side: on an edge, by its parameter.
  int middle(int a, int b) {
    const auto [found, is_new] = middle_of_.try_emplace(ascending(a, b), static_cast<int>(quads_.points.size()));
    if (!is_new) return found->second;
    const Vector3d &p = quads_.points[a], &q = quads_.points[b];
    Vector3d between = (p + q) / 2;
    if (const auto edge = edge_at_.find(ascending(a, b)); edge != edge_at_.end()) {
      const EdgeCurve& curve = curves_.at(edge->second);
      const auto t = curve.ends(p, q);
      between = curve.at((t[0] + t[1]) / 2);
    }
    quads_.points.push_back(between);
    return found->second;
  }

  Triangles mesh_;
  std::map<int, EdgeCurve> curves_{};
  std::map<Ends, int> edge_at_{}, middle_of_{};
  Quads quads_{};
};

}  // namespace

Quads quads_of(const JoinedPart& part, double size, const std::vector<SmallPlace>& small) {
  constexpr double side = 2.2;  // of triangles that become quadrilaterals with sides of about 1
  const domain::GmshSession session;
  gmsh::option::setNumber("General.NumThreads", 1);
  try {
    gmsh::vectorpair entities;
    gmsh::model::occ::importShapesNativePointer(&part.shape, entities, false);
    gmsh::model::occ::synchronize();
    domain::GmshSession::check();
    // Each side is divided later, so that a circle then has twelve sides or more.
    gmsh::option::setNumber("Mesh.MinimumCircleNodes", 6);
    // Without a factor Gmsh takes no sides longer than a tenth of the diagonal.
    const double factor = std::max(1.0, 10 * side * size / diagonal_of(part.shape));
    gmsh::option::setNumber("Mesh.MeshSizeMax", side * size / factor);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", factor);
    if (!small.empty())
      gmsh::model::mesh::setSizeCallback([&, factor](int, int, double x, double y, double z) {
        constexpr double growth = 0.5;
        double least = size;
        for (const SmallPlace& place : small) {
          const double away = std::max(0.0, (place.centre - Vector3d(x, y, z)).norm() - 2 * place.size);
          least = std::min(least, place.size + growth * away);
        }
        return side * least / factor;
      });
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 1);
    gmsh::model::mesh::generate(2);
    domain::GmshSession::check();
    return QuadMaker(part, triangles_in_gmsh(part, std::max(part.tolerance, 1e-6 * size))).make();
  } catch (const std::string& error) {  // Gmsh's own
    throw PartError(fmt::format("Gmsh cannot mesh its faces: {}", error));
  } catch (const PartError&) {
    throw;
  } catch (const std::exception& error) {
    throw PartError(fmt::format("Gmsh cannot mesh its faces: {}", error.what()));
  }
}

}  // namespace plastron::cad
