#include <plastron/report/surface_scene.hpp>

#include <plastron/io/bytes.hpp>
#include <plastron/topology/disjoint_sets.hpp>
#include <plastron/topology/surface_patch.hpp>

#include <algorithm>
#include <map>
#include <numbers>

namespace plastron::report {

namespace {

using Eigen::Vector3d;

/// Kinds of drawn edges, in the order of their numbers in the scene.
enum class DrawnKind : std::uint32_t { border, between_regions, curve, fold, branch };
constexpr std::array kind_names{"border", "between regions", "curve inside a region", "fold", "branch"};

struct DrawnEdge {
  std::size_t edge;
  DrawnKind kind;
  bool is_doubtful;
};

class SceneBuilder {
 public:
  SceneBuilder(const domain::FileSurface& surface, const std::vector<CurvePart>& curves, int subdivisions)
      : topology_(surface.topology), curves_(curves), subdivisions_(subdivisions) {
    choose_edges();
  }

  void add_cells(Json& scene) const {
    const topology::SpaceMesh& mesh = topology_.mesh;
    const Vector3d origin = mesh.nodes[static_cast<std::size_t>(mesh.cells.front().nodes.front())];
    topology::PatchTables tables(mesh.shape, [&](int) { return mesh::lattice(mesh.shape, subdivisions_); });
    std::vector<float> points, normals;
    std::vector<std::uint32_t> region, line, turned;
    std::vector<double> number;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      const topology::SurfaceCell& cell = mesh.cells[c];
      const topology::PatchPoints at = topology::patch_points(tables(cell.order), mesh, cell);
      for (Eigen::Index i = 0; i < at.phi.rows(); ++i) {
        append(Vector3d(at.phi.row(i)) - origin, points);
        append(at.normal(i).normalized(), normals);
      }
      region.push_back(static_cast<std::uint32_t>(cell.region));
      line.push_back(static_cast<std::uint32_t>(cell.line));
      turned.push_back(topology_.is_turned[c] ? 1 : 0);
      number.push_back(static_cast<double>(cell.tag));
    }
    scene["origin"] = {origin[0], origin[1], origin[2]};
    scene["positions"] = io::base64_of_numbers(points);
    scene["normals"] = io::base64_of_numbers(normals);
    scene["region"] = io::base64_of_numbers(region);
    scene["line"] = io::base64_of_numbers(line);
    scene["turned"] = io::base64_of_numbers(turned);
    scene["number"] = io::base64_of_numbers(number);
  }

  void add_edges(Json& scene) const {
    const auto corners = static_cast<std::size_t>(mesh::corner_count(topology_.mesh.shape));
    std::vector<std::uint32_t> kind, doubtful, places, sides(corners * topology_.mesh.cells.size(), 0);
    std::vector<float> angle;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const topology::SurfaceEdge& edge = topology_.edges[edges_[e].edge];
      kind.push_back(static_cast<std::uint32_t>(edges_[e].kind));
      doubtful.push_back(edges_[e].is_doubtful ? 1 : 0);
      angle.push_back(static_cast<float>(edge.angle * 180 / std::numbers::pi));
      for (const std::uint32_t place : places_of(edge)) places.push_back(place);
      for (std::size_t k = 0; k < edge.side_count; ++k) {
        const mesh::MeshEdge& side = topology_.sides[edge.first_side + k];
        sides[corners * side.cell + static_cast<std::size_t>(side.side)] = static_cast<std::uint32_t>(e + 1);
      }
    }
    scene["edges"] = {{"kinds", kind_names},
                      {"kind", io::base64_of_numbers(kind)},
                      {"angle", io::base64_of_numbers(angle)},
                      {"doubtful", io::base64_of_numbers(doubtful)},
                      {"places", io::base64_of_numbers(places)},
                      {"sides", io::base64_of_numbers(sides)}};
  }

  Json curves_json() const {
    Json list = Json::array();
    for (const CurvePart& curve : curves_) {
      std::vector<std::uint32_t> edges;
      for (const std::size_t edge : curve.edges) edges.push_back(number_.at(edge));
      list.push_back({{"name", curve.name},
                      {"is_name", curve.has_name()},
                      {"kinds", kinds_text(curve)},
                      {"edges", io::base64_of_numbers(edges)},
                      {"marks", io::base64_of_numbers(marks_of(curve))}});
    }
    return list;
  }

 private:
  static void append(const Vector3d& v, std::vector<float>& numbers) {
    for (const double value : v) numbers.push_back(static_cast<float>(value));
  }

  /// Chooses borders, folds, branches, doubtful edges, and smooth edges between regions or on curves.
  void choose_edges() {
    std::vector<bool> is_doubtful(topology_.edges.size(), false), is_named = is_doubtful;
    for (const std::size_t e : doubtful_edges(topology_)) is_doubtful[e] = true;
    for (const CurvePart& curve : curves_)
      for (const std::size_t e : curve.edges) is_named[e] = true;
    for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
      const topology::SurfaceEdge& edge = topology_.edges[e];
      const bool is_between = region(edge, 0) != region(edge, edge.side_count - 1);
      if (edge.kind == topology::EdgeKind::smooth && !is_between && !is_named[e] && !is_doubtful[e]) continue;
      number_[e] = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({e, drawn_kind(edge, is_between), is_doubtful[e]});
    }
  }

  int region(const topology::SurfaceEdge& edge, std::size_t side) const {
    return topology_.mesh.cells[topology_.sides[edge.first_side + side].cell].region;
  }

  static DrawnKind drawn_kind(const topology::SurfaceEdge& edge, bool is_between) {
    switch (edge.kind) {
      case topology::EdgeKind::border:
        return DrawnKind::border;
      case topology::EdgeKind::fold:
        return DrawnKind::fold;
      case topology::EdgeKind::branch:
        return DrawnKind::branch;
      default:
        return is_between ? DrawnKind::between_regions : DrawnKind::curve;
    }
  }

  /// Numbers of the points on an edge, in its first cell.
  std::vector<std::uint32_t> places_of(const topology::SurfaceEdge& edge) const {
    const mesh::Shape shape = topology_.mesh.shape;
    const mesh::MeshEdge& side = topology_.sides[edge.first_side];
    const auto first = side.cell * static_cast<std::size_t>(mesh::nodes_per_cell(shape, subdivisions_));
    std::vector<std::uint32_t> places;
    for (const int k : mesh::side_nodes(shape, subdivisions_, side.side))
      places.push_back(static_cast<std::uint32_t>(first + static_cast<std::size_t>(k)));
    return places;
  }

  /// The middles of the longest connected pieces of a curve, each as the point in the middle of an edge.
  std::vector<std::uint32_t> marks_of(const CurvePart& curve) const {
    constexpr std::size_t most_marks = 4;
    if (!curve.has_name()) return {};
    std::vector<std::vector<std::size_t>> pieces = pieces_of(curve);
    std::ranges::stable_sort(pieces, std::greater<>{}, &std::vector<std::size_t>::size);
    if (pieces.size() > most_marks) pieces.resize(most_marks);
    std::vector<std::uint32_t> marks;
    marks.reserve(pieces.size());
    for (const std::vector<std::size_t>& piece : pieces) marks.push_back(mark_of(piece));
    return marks;
  }

  std::vector<std::vector<std::size_t>> pieces_of(const CurvePart& curve) const {
    topology::DisjointSets connected(topology_.mesh.nodes.size());
    const auto end = [&](std::size_t edge, int k) {
      return static_cast<std::size_t>(topology_.edges[edge].ends[static_cast<std::size_t>(k)]);
    };
    for (const std::size_t edge : curve.edges) connected.unite(end(edge, 0), end(edge, 1));
    std::map<std::size_t, std::vector<std::size_t>> pieces;
    for (const std::size_t edge : curve.edges) pieces[connected.of(end(edge, 0))].push_back(edge);
    std::vector<std::vector<std::size_t>> list;
    list.reserve(pieces.size());
    for (auto& [first, edges] : pieces) list.push_back(std::move(edges));
    return list;
  }

  /// The middle point of the edge that is nearest to the mean of all edges' middles.
  std::uint32_t mark_of(const std::vector<std::size_t>& piece) const {
    const auto middle = [&](std::size_t edge) {
      const auto& ends = topology_.edges[edge].ends;
      const auto& nodes = topology_.mesh.nodes;
      return Vector3d((nodes[static_cast<std::size_t>(ends[0])] + nodes[static_cast<std::size_t>(ends[1])]) / 2);
    };
    Vector3d mean = Vector3d::Zero();
    for (const std::size_t edge : piece) mean += middle(edge) / static_cast<double>(piece.size());
    const auto nearest =
        std::ranges::min_element(piece, {}, [&](std::size_t edge) { return (middle(edge) - mean).squaredNorm(); });
    return places_of(topology_.edges[*nearest])[static_cast<std::size_t>(subdivisions_) / 2];
  }

  const topology::SurfaceTopology& topology_;
  const std::vector<CurvePart>& curves_;
  int subdivisions_;
  std::vector<DrawnEdge> edges_{};
  std::map<std::size_t, std::uint32_t> number_{};  ///< of each drawn edge of the topology: its number in the scene
};

int largest_order(const topology::SpaceMesh& mesh) {
  return std::ranges::max(mesh.cells, {}, &topology::SurfaceCell::order).order;
}

}  // namespace

int parts_subdivisions(const topology::SpaceMesh& mesh, std::size_t most_points, std::size_t most_smooth) {
  const auto points = [&](int n) {
    return mesh.cells.size() * static_cast<std::size_t>(mesh::nodes_per_cell(mesh.shape, n));
  };
  constexpr int usual = 4;
  const int order = largest_order(mesh);
  int n = order == 1 ? 1 : std::max(usual, order);
  while (n > 1 && points(n) > std::min(most_points, most_smooth)) --n;
  return points(n) > most_points ? 0 : n;
}

Json surface_scene_json(const domain::FileSurface& surface, const std::vector<RegionPart>& regions,
                        const std::vector<CurvePart>& curves, std::size_t most_points) {
  const topology::SpaceMesh& mesh = surface.topology.mesh;
  const int n = parts_subdivisions(mesh, most_points);
  if (n == 0) return nullptr;
  const SceneBuilder builder(surface, curves, n);
  Json scene{{"kind", "parts"},
             {"shape", mesh.shape == mesh::Shape::triangle ? "triangle" : "quadrilateral"},
             {"subdivisions", n},
             {"length", "m"},
             {"degree", largest_order(mesh)},
             {"cells", mesh.cells.size()}};
  Json list = Json::array();
  for (const RegionPart& region : regions)
    list.push_back({{"name", name_text(region)}, {"is_name", !region.name.empty()}, {"cells", region.cells}});
  scene["regions"] = std::move(list);
  scene["curves"] = builder.curves_json();
  builder.add_cells(scene);
  builder.add_edges(scene);
  return scene;
}

}  // namespace plastron::report
