#include "quads.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <TopoDS.hxx>

#include <fmt/format.h>
#include <gmsh.h>

#include <cmath>
#include <map>
#include <string_view>

namespace plastron::cad {

namespace {

class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 1);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::logger::start();
  }
  ~GmshSession() {
    gmsh::logger::stop();
    gmsh::finalize();
  }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  static void check() {
    constexpr std::string_view mark = "Error: ";
    std::vector<std::string> log;
    gmsh::logger::get(log);
    for (const std::string& entry : log)
      if (entry.starts_with(mark)) throw PartError(fmt::format("Gmsh cannot mesh its faces: {}", entry.substr(mark.size())));
  }
};

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

struct Elements {
  std::vector<std::size_t> nodes;
  std::size_t per_element = 0;
};

/// Calls visit(nodes) for each element of an entity with this number of nodes; others are counted.
template <class Visit>
std::size_t for_each_element(int dimension, int entity, std::size_t count, const Visit& visit) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  std::size_t others = 0;
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (tags[t].empty()) continue;
    if (nodes[t].size() != count * tags[t].size()) {
      others += tags[t].size();
      continue;
    }
    for (std::size_t e = 0; e < tags[t].size(); ++e) visit(&nodes[t][count * e]);
  }
  return others;
}

Quads mesh_in_gmsh(const JoinedPart& part, double tolerance) {
  Quads quads;
  std::map<std::size_t, int> number;
  std::vector<std::size_t> tags;
  std::vector<double> x, parametric;
  gmsh::model::mesh::getNodes(tags, x, parametric);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    number[tags[i]] = static_cast<int>(i);
    quads.points.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  }
  CurveEdges edges(part, tolerance);
  gmsh::vectorpair curves, surfaces;
  gmsh::model::getEntities(curves, 1);
  for (const auto& [dimension, curve] : curves) {
    int edge = 0;
    for_each_element(1, curve, 2, [&](const std::size_t* n) {
      if (edge == 0) edge = edges.edge_of(curve);
      quads.lines.push_back({{number[n[0]], number[n[1]]}, edge});
    });
  }
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dimension, surface] : surfaces) {
    const int face = face_of(part, surface);
    const std::size_t before = quads.cells.size();
    const std::size_t others = for_each_element(2, surface, 4, [&](const std::size_t* n) {
      quads.cells.push_back({{number[n[0]], number[n[1]], number[n[2]], number[n[3]]}, face});
    });
    if (others > 0) throw PartError(fmt::format("Gmsh leaves triangles on face {}", part.labelled[face - 1].number));
    if (quads.cells.size() == before)
      throw PartError(fmt::format("Gmsh makes no cells on face {}", part.labelled[face - 1].number));
  }
  return quads;
}

}  // namespace

Quads quads_of(const JoinedPart& part, double size, const std::vector<SmallPlace>& small) {
  const GmshSession session;
  try {
    gmsh::vectorpair entities;
    gmsh::model::occ::importShapesNativePointer(&part.shape, entities, false);
    gmsh::model::occ::synchronize();
    GmshSession::check();
    // Each quadrilateral is divided into four, so that no triangle is left; a circle then has eight sides or more.
    gmsh::option::setNumber("Mesh.RecombineAll", 1);
    gmsh::option::setNumber("Mesh.RecombinationAlgorithm", 1);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 1);
    gmsh::option::setNumber("Mesh.MinimumCircleNodes", 4);
    gmsh::option::setNumber("Mesh.MeshSizeMax", 2 * size);
    if (!small.empty())
      gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z) {
        constexpr double growth = 0.5;
        double least = size;
        for (const SmallPlace& place : small) {
          const double away = std::max(0.0, (place.centre - Vector3d(x, y, z)).norm() - 2 * place.size);
          least = std::min(least, place.size + growth * away);
        }
        return 2 * least;
      });
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 1);
    gmsh::model::mesh::generate(2);
    GmshSession::check();
    return mesh_in_gmsh(part, std::max(part.tolerance, 1e-6 * size));
  } catch (const std::string& error) {  // Gmsh's own
    throw PartError(fmt::format("Gmsh cannot mesh its faces: {}", error));
  } catch (const PartError&) {
    throw;
  } catch (const std::exception& error) {
    throw PartError(fmt::format("Gmsh cannot mesh its faces: {}", error.what()));
  }
}

}  // namespace plastron::cad
