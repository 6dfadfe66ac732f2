#include <plastron/report/surface_parts.hpp>

#include <plastron/topology/surface_patch.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace plastron::report {

namespace {

using Eigen::Vector3d;

const Vector3d& place(const topology::SpaceMesh& mesh, std::int32_t node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

/// Returns the vector with 0 for components below a limit.
Vector3d cleared(const Vector3d& v, double limit) { return (v.array().abs() < limit).select(0, v); }

/// Length of the polynomial through points at equal steps of its parameter.
double length_of(const std::vector<Vector3d>& points) {
  const std::size_t order = points.size() - 1;
  std::vector<double> nodes;
  for (std::size_t k = 0; k <= order; ++k) nodes.push_back(static_cast<double>(k) / static_cast<double>(order));
  const mesh::Rule rule = mesh::gauss(static_cast<int>(order) + 2);
  double length = 0;
  for (std::size_t p = 0; p < rule.points.size(); ++p) {
    const auto slopes = mesh::lagrange(nodes, rule.points[p]).d;
    Vector3d tangent = Vector3d::Zero();
    for (std::size_t k = 0; k <= order; ++k) tangent += slopes[static_cast<Eigen::Index>(k)] * points[k];
    length += rule.weights[p] * tangent.norm();
  }
  return length;
}

void add_edge(const topology::SurfaceTopology& topology, std::size_t index, CurvePart& curve) {
  const topology::SurfaceEdge& edge = topology.edges[index];
  curve.edges.push_back(index);
  ++curve.kinds[static_cast<std::size_t>(edge.kind)];
  curve.largest_angle = std::max(curve.largest_angle, edge.angle);
  const mesh::MeshEdge& side = topology.sides[edge.first_side];
  const auto& nodes = topology.mesh.cells[side.cell].nodes;
  const std::vector<int> places = topology::ascending_places(topology.mesh, side);
  std::vector<Vector3d> points;
  for (const int at : places) {
    points.push_back(place(topology.mesh, nodes[static_cast<std::size_t>(at)]));
    curve.low = curve.low.cwiseMin(points.back());
    curve.high = curve.high.cwiseMax(points.back());
  }
  curve.length += length_of(points);
}

/// Adds "fold 1", "fold 2", ..., whose names and edges are those of the coarse mesh. An edge there has as many entries
/// as cells.
void add_folds(const domain::FileSurface& surface, std::vector<CurvePart>& curves) {
  const topology::SurfaceTopology& topology = surface.topology;
  const mesh::CoarseMesh coarse = domain::surface_mesh(surface, topology.mesh.shape);
  const std::size_t of_file = surface.boundaries.size();
  std::vector<std::set<std::size_t>> edges(coarse.boundaries.size() - of_file);
  const auto node = [&](int vertex) {
    const std::int32_t copy = topology.vertex_director_nodes[static_cast<std::size_t>(vertex)];
    return topology.director_nodes[static_cast<std::size_t>(copy)].node;
  };
  for (const mesh::BoundaryEdge& edge : coarse.edges) {
    if (edge.boundary < static_cast<int>(of_file)) continue;
    const auto* found = topology::find_edge(topology, {node(edge.vertices[0]), node(edge.vertices[1])});
    edges[static_cast<std::size_t>(edge.boundary) - of_file].insert(
        static_cast<std::size_t>(found - topology.edges.data()));
  }
  for (std::size_t f = 0; f < edges.size(); ++f) {
    curves.push_back({.name = coarse.boundaries[of_file + f], .is_in_file = false});
    for (const std::size_t edge : edges[f]) add_edge(topology, edge, curves.back());
  }
}

/// Adds edges that no curve has yet, as two groups.
void add_rest(const topology::SurfaceTopology& topology, std::vector<CurvePart>& curves) {
  std::vector<bool> is_known(topology.edges.size(), false);
  for (const CurvePart& curve : curves)
    for (const std::size_t edge : curve.edges) is_known[edge] = true;
  CurvePart borders{.name = "(borders without name)", .is_in_file = false};
  CurvePart folds{.name = "(folds that count as smooth)", .is_in_file = false};
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const topology::EdgeKind kind = topology.edges[e].kind;
    if (is_known[e] || kind == topology::EdgeKind::smooth) continue;
    add_edge(topology, e, kind == topology::EdgeKind::border ? borders : folds);
  }
  for (CurvePart* group : {&borders, &folds})
    if (!group->edges.empty()) curves.push_back(std::move(*group));
}

}  // namespace

std::vector<RegionPart> region_parts(const domain::FileSurface& surface) {
  const topology::SurfaceTopology& topology = surface.topology;
  std::vector<RegionPart> parts;
  for (const std::string& name : surface.regions) parts.push_back({.name = name, .middle = Vector3d::Zero()});
  std::vector<Vector3d> area_vectors(parts.size(), Vector3d::Zero());
  const auto integrals = topology::patch_integrals(topology.mesh, Vector3d::Zero());
  for (std::size_t c = 0; c < topology.mesh.cells.size(); ++c) {
    const topology::SurfaceCell& cell = topology.mesh.cells[c];
    const auto r = static_cast<std::size_t>(cell.region);
    ++parts[r].cells;
    parts[r].turned += topology.is_turned[c] ? 1 : 0;
    parts[r].area += integrals[c].area;
    area_vectors[r] += integrals[c].area_vector;
    Vector3d middle = Vector3d::Zero();
    for (const std::int32_t node : cell.nodes)
      middle += place(topology.mesh, node) / static_cast<double>(cell.nodes.size());
    parts[r].middle += integrals[c].area * middle;
  }
  for (std::size_t r = 0; r < parts.size(); ++r) {
    constexpr double rounding = 1e-12, negligible = 1e-6;  // relative to the region's size and area
    if (parts[r].area > 0)
      parts[r].middle = cleared(Vector3d(parts[r].middle / parts[r].area), rounding * std::sqrt(parts[r].area));
    if (area_vectors[r].norm() > negligible * parts[r].area) parts[r].normal = area_vectors[r].normalized();
  }
  return parts;
}

std::vector<CurvePart> curve_parts(const domain::FileSurface& surface) {
  std::vector<CurvePart> curves;
  for (const std::string& name : surface.boundaries) curves.push_back({.name = name});
  for (const domain::NamedEdge& named : surface.named_edges)
    add_edge(surface.topology, named.edge, curves[static_cast<std::size_t>(named.boundary)]);
  add_folds(surface, curves);
  add_rest(surface.topology, curves);
  return curves;
}

std::vector<std::size_t> doubtful_edges(const topology::SurfaceTopology& topology) {
  std::set<std::size_t> doubtful(topology.edges_near_limit.begin(), topology.edges_near_limit.end());
  for (std::size_t e = 0; e < topology.edges.size(); ++e)
    if (topology.edges[e].is_lone_fold) doubtful.insert(e);
  return {doubtful.begin(), doubtful.end()};
}

std::string name_text(const RegionPart& region) { return region.name.empty() ? "(no name)" : region.name; }

std::string normal_text(const RegionPart& region) {
  if (!region.normal) return "none: they cancel";
  constexpr double shown = 5e-4;  // of three decimals
  return fmt::format("({:.3f})", fmt::join(cleared(*region.normal, shown), ", "));
}

std::string_view kind_word(topology::EdgeKind kind) {
  constexpr std::array<std::string_view, 4> words{"border", "smooth", "fold", "branch"};
  return words[static_cast<std::size_t>(kind)];
}

std::string kinds_text(const CurvePart& curve) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < curve.kinds.size(); ++k)
    if (curve.kinds[k] > 0)
      texts.push_back(fmt::format("{} {}", curve.kinds[k], kind_word(static_cast<topology::EdgeKind>(k))));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace plastron::report
