// Polygons, meshed by Gmsh through its geometry interface. Gmsh never opens a file here, because it would execute
// scripts (docs/decisions/0008-mesh-files.md).
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/domain/gmsh_session.hpp>
#include <plastron/domain/mesh_data.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::domain {

namespace {

using Eigen::Vector3d;

/// Adds the elements of the entities of one dimension; each entity's number is its group.
void add_elements(int dimension, MeshData& data) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  for (const auto& [unused, entity] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    data.group_sets.push_back({entity});
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t per_element = nodes[t].size() / std::max<std::size_t>(1, tags[t].size());
      for (std::size_t e = 0; e < tags[t].size(); ++e) {
        data.elements.push_back({.tag = static_cast<std::int64_t>(tags[t][e]),
                                 .type = types[t],
                                 .first_node = data.element_nodes.size(),
                                 .groups = data.group_sets.size() - 1});
        for (std::size_t i = 0; i < per_element; ++i)
          data.element_nodes.push_back(static_cast<std::int64_t>(nodes[t][e * per_element + i]));
      }
    }
  }
}

/// The mesh of Gmsh's current model, its lengths multiplied by `scale`.
MeshData meshed(double scale) {
  MeshData data;
  data.source = "polygon";
  std::vector<std::size_t> tags;
  std::vector<double> x, parametric;
  gmsh::model::mesh::getNodes(tags, x, parametric);
  for (std::size_t i = 0; i < tags.size(); ++i)
    data.nodes.push_back({static_cast<std::int64_t>(tags[i]), scale * Vector3d(x[3 * i], x[3 * i + 1], x[3 * i + 2])});
  add_elements(1, data);
  add_elements(2, data);
  number_nodes(data);
  return data;
}

mesh::CoarseMesh single_cell(const Polygon& polygon) {
  mesh::CoarseMesh mesh;
  mesh.vertices = polygon.corners;
  mesh.regions = {""};
  mesh.boundaries = boundary_names(Domain{polygon});
  for (int i = 0; i < 4; ++i) mesh.edges.push_back({{i, (i + 1) % 4}, i});
  const bool anticlockwise = signed_area(polygon) > 0;
  const std::array<int, 4> v = anticlockwise ? std::array{0, 1, 3, 2} : std::array{0, 3, 1, 2};
  const auto& p = polygon.corners;
  mesh.cells.push_back({v, 0, {mesh::LagrangeMap{1, {p[v[0]], p[v[1]], p[v[2]], p[v[3]]}}}});
  return mesh;
}

/// A power of two near a polygon's size. Gmsh has absolute tolerances of length; division by a power of two causes no
/// rounding.
double scale_of(const Polygon& polygon) {
  Vector2d low = polygon.corners.front(), high = low;
  for (const Vector2d& c : polygon.corners) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  return std::exp2(std::ceil(std::log2((high - low).maxCoeff())));
}

/// Draws the polygon. Curve i is the side from corner i to the next; numbers start with 1.
void draw(const Polygon& polygon, double length, double scale) {
  const auto& p = polygon.corners;
  std::vector<int> points, lines;
  for (const Vector2d& c : p)
    points.push_back(gmsh::model::geo::addPoint(c[0] / scale, c[1] / scale, 0, length / scale));
  for (std::size_t i = 0; i < p.size(); ++i)
    lines.push_back(gmsh::model::geo::addLine(points[i], points[(i + 1) % p.size()], static_cast<int>(i) + 1));
  gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(lines)}, 1);
  gmsh::model::geo::synchronize();
}

}  // namespace

mesh::CoarseMesh mesh_polygon(const Polygon& polygon, mesh::Shape shape) {
  if (is_convex_quadrilateral(polygon))
    return shape == mesh::Shape::triangle ? mesh::cut_crosswise(single_cell(polygon)) : single_cell(polygon);
  return gmsh_polygon(polygon, shape, perimeter(polygon) / 8);
}

mesh::CoarseMesh gmsh_polygon(const Polygon& polygon, mesh::Shape shape, double length) {
  const GmshSession session;
  try {
    const double scale = scale_of(polygon);
    draw(polygon, length, scale);
    GmshSession::check();
    gmsh::option::setNumber("Mesh.RecombineAll", shape == mesh::Shape::quadrilateral ? 1 : 0);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", shape == mesh::Shape::quadrilateral ? 1 : 0);
    gmsh::model::mesh::generate(2);
    GmshSession::check();
    MeshData data = meshed(scale);
    const auto names = boundary_names(Domain{polygon});
    for (std::size_t i = 0; i < names.size(); ++i) data.names[{1, static_cast<int>(i) + 1}] = names[i];
    data.names[{2, 1}] = "";
    return build_coarse_mesh(data, shape);
  } catch (const mesh::DomainError&) {
    throw;
  } catch (const std::exception& error) {
    throw mesh::DomainError(fmt::format("polygon: Gmsh cannot mesh it: {}", error.what()));
  }
}

}  // namespace plastron::domain
