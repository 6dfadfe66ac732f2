// Coarse meshes that come from Gmsh: .msh files, and polygons meshed on the spot.
#include <plastron/fem/coarse_mesh.hpp>

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace plastron::fem {

namespace {

/// Gmsh has one global state: alive for the length of one reading or meshing, silent.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 2);  // throw
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

struct Node {
  int index;
  Vector2d position;
};

class Reader {
 public:
  Reader(std::string source, Shape shape) : source_(std::move(source)) { mesh_.shape = shape; }

  CoarseMesh read() {
    read_nodes();
    read_cells();
    read_boundaries();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw DomainError(fmt::format("{}: {}", source_, what)); }

  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> x, parametric;
    gmsh::model::mesh::getNodes(tags, x, parametric);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (std::abs(x[3 * i + 2]) > 1e-12 * (std::abs(x[3 * i]) + std::abs(x[3 * i + 1]) + 1))
        refuse(fmt::format("node {} has z = {:g}; the mesh must lie in the parameter plane z = 0, the chart lifts it",
                           tags[i], x[3 * i + 2]));
      nodes_[tags[i]] = {-1, {x[3 * i], x[3 * i + 1]}};
    }
  }

  /// The vertex index of a node, given on its first use as a corner.
  int vertex(std::size_t tag) {
    Node& node = nodes_.at(tag);
    if (node.index < 0) {
      node.index = static_cast<int>(mesh_.vertices.size());
      mesh_.vertices.push_back(node.position);
    }
    return node.index;
  }

  void read_cells() {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, 2);
    if (groups.empty()) {
      mesh_.regions = {""};
      read_surface(-1, 0);
    }
    for (const auto& [dimension, tag] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(2, tag, name);
      if (name.empty()) refuse(fmt::format("physical surface {} has no name; name it after its region", tag));
      const int region = static_cast<int>(mesh_.regions.size());
      mesh_.regions.push_back(name);
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(2, tag, entities);
      for (const int entity : entities) {
        if (!seen_.insert(entity).second) refuse(fmt::format("surface {} lies in two physical surfaces", entity));
        read_surface(entity, region);
      }
    }
    if (mesh_.cells.empty())
      refuse(mesh_.shape == Shape::triangle
                 ? "it has no triangles; mesh the surface, save it with its physical groups"
                 : "it has no quadrilaterals; mesh the surface with Recombine, save it with its physical groups");
  }

  void read_surface(int entity, int region) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 2, entity);
    for (std::size_t t = 0; t < types.size(); ++t) read_elements(types[t], nodes[t], region);
  }

  void read_elements(int type, const std::vector<std::size_t>& tags, int region) {
    std::string name;
    int dimension = 0, order = 0, count = 0, corners = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, count, local, corners);
    const Shape shape = corners == 3 ? Shape::triangle : Shape::quadrilateral;
    check_elements(name, shape, corners <= 4 && count == nodes_per_cell(shape, order));
    const auto slot = slots(shape, order, local);
    for (std::size_t e = 0; e * slot.size() < tags.size(); ++e) {
      const std::size_t* of_element = &tags[e * slot.size()];
      std::vector<Vector2d> nodes(slot.size());
      for (std::size_t i = 0; i < slot.size(); ++i) nodes[slot[i]] = nodes_.at(of_element[i]).position;
      if (shape == Shape::triangle)
        add_cell(shape, {{vertex(of_element[0]), vertex(of_element[1]), vertex(of_element[2]), -1},
                         region,
                         {TriangleLagrangeMap{order, std::move(nodes)}}});
      else  // Gmsh's corners run round the cell
        add_cell(shape, {{vertex(of_element[0]), vertex(of_element[1]), vertex(of_element[3]), vertex(of_element[2])},
                         region,
                         {LagrangeMap{order, std::move(nodes)}}});
    }
  }

  void check_elements(const std::string& type, Shape shape, bool is_complete) const {
    if (mesh_.shape == Shape::quadrilateral && (shape == Shape::triangle || !is_complete))
      refuse(
          fmt::format("it has elements of type \"{}\"; with cells = \"quadrilateral\" only complete quadrilaterals are "
                      "allowed (Recombine Surface, Mesh.SecondOrderIncomplete = 0){}",
                      type, shape == Shape::triangle ? "; cells = \"triangle\" in [mesh] takes triangles" : ""));
    if (!is_complete)
      refuse(
          fmt::format("it has elements of type \"{}\"; only complete triangles and quadrilaterals are allowed "
                      "(Mesh.SecondOrderIncomplete = 0)",
                      type));
  }

  /// Position of each of Gmsh's local nodes on the lexicographic lattice of the reference cell. Gmsh's square is
  /// [-1, 1]^2, its triangle is ours.
  static std::vector<std::size_t> slots(Shape shape, int order, const std::vector<double>& local) {
    const auto points = lattice(shape, order);
    std::vector<std::size_t> slot(points.size());
    for (std::size_t i = 0; i < slot.size(); ++i) {
      Vector2d at(local[2 * i], local[2 * i + 1]);
      if (shape == Shape::quadrilateral) at = (at + Vector2d::Ones()) / 2;
      slot[i] = static_cast<std::size_t>(
          std::ranges::find_if(points, [&](const Vector2d& p) { return (p - at).norm() < 0.1 / order; }) -
          points.begin());
    }
    return slot;
  }

  void add_cell(Shape shape, CoarseCell cell) {
    const PlaneJet middle = cell.map(centre(shape));
    if (middle.d[0][0] * middle.d[1][1] < middle.d[0][1] * middle.d[1][0]) {
      // A cell drawn clockwise: swap its two coordinates, so that every a_3 points to the same side.
      std::swap(cell.vertices[1], cell.vertices[2]);
      cell.map.axes << 0, 1, 1, 0;
    }
    if (shape == mesh_.shape)
      mesh_.cells.push_back(std::move(cell));
    else
      cut_crosswise(cell, mesh_);
  }

  void read_boundaries() {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, 1);
    for (const auto& [dimension, tag] : groups) {
      std::string name;
      gmsh::model::getPhysicalName(1, tag, name);
      if (name.empty()) refuse(fmt::format("physical curve {} has no name; name it after its boundary", tag));
      const int boundary = static_cast<int>(mesh_.boundaries.size());
      mesh_.boundaries.push_back(name);
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(1, tag, entities);
      for (const int entity : entities) read_curve(entity, boundary);
    }
  }

  void read_curve(int entity, int boundary) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 1, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t per_element = nodes[t].size() / std::max<std::size_t>(1, elements[t].size());
      for (std::size_t e = 0; e < elements[t].size(); ++e) {
        const Node& a = nodes_.at(nodes[t][e * per_element]);
        const Node& b = nodes_.at(nodes[t][e * per_element + 1]);
        if (a.index >= 0 && b.index >= 0) mesh_.edges.push_back({{a.index, b.index}, boundary});
      }
    }
  }

  std::string source_;
  CoarseMesh mesh_;
  std::map<std::size_t, Node> nodes_;
  std::set<int> seen_;
};

bool is_convex_quadrilateral(const std::vector<Vector2d>& p) {
  if (p.size() != 4) return false;
  double sign = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d a = p[(i + 1) % 4] - p[i], b = p[(i + 2) % 4] - p[(i + 1) % 4];
    const double turn = a[0] * b[1] - a[1] * b[0];
    if (turn * sign < 0 || std::abs(turn) < 1e-3 * a.norm() * b.norm()) return false;
    sign = turn;
  }
  return true;
}

double signed_area(const std::vector<Vector2d>& p) {
  double area = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector2d& q = p[(i + 1) % p.size()];
    area += (p[i][0] * q[1] - q[0] * p[i][1]) / 2;
  }
  return area;
}

CoarseMesh single_cell(const Polygon& polygon) {
  CoarseMesh mesh;
  mesh.vertices = polygon.corners;
  mesh.regions = {""};
  mesh.boundaries = boundary_names(Domain{polygon});
  for (int i = 0; i < 4; ++i) mesh.edges.push_back({{i, (i + 1) % 4}, i});
  const bool anticlockwise = signed_area(polygon.corners) > 0;
  const std::array<int, 4> v = anticlockwise ? std::array{0, 1, 3, 2} : std::array{0, 3, 1, 2};
  const auto& p = polygon.corners;
  mesh.cells.push_back({v, 0, {LagrangeMap{1, {p[v[0]], p[v[1]], p[v[2]], p[v[3]]}}}});
  return mesh;
}

void draw(const Polygon& polygon) {
  const auto& p = polygon.corners;
  double perimeter = 0;
  for (std::size_t i = 0; i < p.size(); ++i) perimeter += (p[(i + 1) % p.size()] - p[i]).norm();
  const auto names = boundary_names(Domain{polygon});
  std::vector<int> points, lines;
  for (const Vector2d& c : p) points.push_back(gmsh::model::geo::addPoint(c[0], c[1], 0, perimeter / 8));
  for (std::size_t i = 0; i < p.size(); ++i)
    lines.push_back(gmsh::model::geo::addLine(points[i], points[(i + 1) % p.size()]));
  const int surface = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(lines)});
  gmsh::model::geo::synchronize();
  for (std::size_t i = 0; i < lines.size(); ++i)
    gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {lines[i]}), names[i]);
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {surface}), "polygon");
}

}  // namespace

CoarseMesh read_mesh_file(const MeshFile& file, Shape shape) {
  if (!std::filesystem::is_regular_file(file.path))
    throw DomainError(fmt::format("{}: there is no such mesh file", file.path));
  const GmshSession session;
  try {
    gmsh::open(file.path);
    return Reader(file.path, shape).read();
  } catch (const DomainError&) {
    throw;
  } catch (const std::exception& error) {
    throw DomainError(fmt::format("{}: Gmsh cannot read it: {}", file.path, error.what()));
  } catch (...) {
    throw DomainError(fmt::format("{}: Gmsh cannot read it; is it a .msh file?", file.path));
  }
}

CoarseMesh mesh_polygon(const Polygon& polygon, Shape shape) {
  if (is_convex_quadrilateral(polygon.corners))
    return shape == Shape::triangle ? cut_crosswise(single_cell(polygon)) : single_cell(polygon);
  const GmshSession session;
  try {
    draw(polygon);
    gmsh::option::setNumber("Mesh.RecombineAll", shape == Shape::quadrilateral ? 1 : 0);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", shape == Shape::quadrilateral ? 1 : 0);
    gmsh::model::mesh::generate(2);
    CoarseMesh mesh = Reader("polygon", shape).read();
    mesh.regions = {""};
    return mesh;
  } catch (const DomainError&) {
    throw;
  } catch (const std::exception& error) {
    throw DomainError(fmt::format("polygon: Gmsh cannot mesh it: {}", error.what()));
  }
}

}  // namespace plastron::fem
