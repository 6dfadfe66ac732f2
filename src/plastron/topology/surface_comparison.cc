#include <plastron/topology/surface_comparison.hpp>

#include <plastron/mesh/basis.hpp>
#include <plastron/topology/height_fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace plastron::topology {

using Eigen::Vector2d;

namespace {

using geometry::Vector3d;

constexpr int highest_fitted = 2;  // order of cells that are fitted to their neighbours
constexpr int more_orders = 2;     // of the patches then
constexpr int most_more = 4;       // degrees of a fit above the order of the cells
constexpr int highest_fit = 8;
constexpr double used_share = 0.6;                     // coefficients over nodes, at most
constexpr double least_cosine = 0.5;                   // of the directors of a neighbour and the plane's normal
constexpr double fitting = 0.25;                       // largest residual over the correction that a fit makes
constexpr double most_of_sag = 2, most_of_bend = 0.1;  // largest corrections of cells of order 1, and of others
constexpr double no_correction = 1e-8;                 // correction over the size of the stencil

using Nodes = std::vector<std::int32_t>;

struct CellFit {
  FitPlane plane;
  HeightFit heights;

  /// Height of the fit over a point, over the plane's scale.
  double lift(const Vector3d& point) const {
    const Vector3d at = plane.local(point);
    return heights.height(at[0], at[1]) - at[2];
  }
};

/// Place and director of a point of the new surface.
struct NewNode {
  Vector3d position, director;
};

class SecondSurface {
 public:
  SecondSurface(const mesh::CoarseMesh& mesh, const std::vector<std::string>& symmetric)
      : mesh_(mesh), old_(*mesh.patches), order_(new_order()) {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (int k = 0; k < mesh::corner_count(mesh.shape); ++k)
        cells_at_[mesh.cells[c].vertices[static_cast<std::size_t>(k)]].push_back(c);
    for (const mesh::Fold& fold : mesh.folds)
      for (const auto& edge : fold.edges) {
        folds_.insert(edge);
        fold_vertices_.insert(edge.begin(), edge.end());
      }
    for (std::size_t b = 0; b < mesh.boundaries.size(); ++b)
      if (std::ranges::count(symmetric, mesh.boundaries[b]) > 0) add_symmetric(static_cast<int>(b));
  }

  SurfaceComparison run();

 private:
  void add_cells(SurfaceComparison& comparison);
  void judge_decay(SurfaceComparison& comparison) const;
  using Edge = std::array<int, 2>;
  /// Adds the edges of a boundary in a plane of symmetry. A straight boundary does not determine its plane: its directors do, and
  /// those of the second surface may have another one.
  void add_symmetric(int boundary);
  /// Vertex {v, -1, 0}, the k-th point of a side {low, high, k}, or a point inside of a cell {-1, cell, k}.
  using Key = std::array<int, 3>;

  static Edge ascending(Edge edge) { return edge[0] < edge[1] ? edge : Edge{edge[1], edge[0]}; }
  int highest_order() const {
    return std::ranges::max_element(old_.patches, {}, &mesh::SurfacePatches::Patch::order)->order;
  }
  bool is_fitted() const { return highest_order() <= highest_fitted; }
  int new_order() const { return is_fitted() ? highest_order() + more_orders : highest_order() - 1; }
  const mesh::SurfacePatches::Patch& patch(std::size_t cell) const {
    return old_.patches[static_cast<std::size_t>(mesh_.cells[cell].patch)];
  }
  geometry::Frame frame(std::size_t cell, const Vector2d& xi) const;
  FitPlane plane_of(std::size_t cell) const;
  Vector3d position(std::int32_t node) const { return old_.positions[static_cast<std::size_t>(node)]; }
  bool has_vertex(std::size_t cell, int vertex) const {
    return std::ranges::count(mesh_.cells[cell].vertices, vertex) > 0;
  }
  /// Nodes of the cell and of the cells around it whose normals are not too far from the plane's. `without`: a side of
  /// the cell, whose cells beyond it are left out; -1: none.
  std::set<std::int32_t> stencil(std::size_t cell, const FitPlane& plane, int without) const;
  /// Fits the nodes by the highest degree that they allow; empty if it is not above the order of the cells.
  std::optional<CellFit> fit_nodes(const std::set<std::int32_t>& nodes, FitPlane plane, int order) const;
  /// Largest height of the fit over the cell, over the plane's scale.
  double correction(std::size_t cell, const CellFit& fit) const;
  /// Interpolates phi at lattice(shape, order) of the cell [m].
  Vector3d interpolated(std::size_t cell, int order, const Vector2d& xi) const;
  /// Largest distance of the cell's interpolants of this order and of one order less; for order 1 the sag between the
  /// corners [m].
  double bend(std::size_t cell, int order) const;
  std::optional<CellFit> fit(std::size_t cell) const;
  Key key(std::size_t cell, const Vector2d& xi, int number) const;
  bool is_kept(const Key& key) const;
  NewNode moved(std::size_t cell, const CellFit& fit, const Key& key, const Vector2d& xi) const;
  /// Keeps the point and its director in the plane of a symmetric edge.
  void put_into_plane(std::size_t cell, const Edge& edge, const geometry::Frame& before, NewNode& node) const;
  void add(std::size_t cell, const Vector2d& xi, int number, const std::optional<CellFit>& fit);

  const mesh::CoarseMesh& mesh_;
  const mesh::SurfacePatches& old_;
  int order_;
  std::map<int, std::vector<std::size_t>> cells_at_{};  ///< by vertex
  std::set<Edge> folds_{}, symmetric_{};
  std::set<int> fold_vertices_{};

  struct Sum {
    Vector3d before, position, director;
    int count = 0;
    std::int32_t node = 0;
  };
  std::map<Key, Sum> sums_{};
  std::vector<std::vector<std::int32_t>> nodes_of_{};  ///< new nodes by cell
};

void SecondSurface::add_symmetric(int boundary) {
  constexpr double straight = 1e-6;  // relative to the length
  std::set<Edge> edges;
  std::set<std::int32_t> nodes;
  for (const mesh::BoundaryEdge& edge : mesh_.edges)
    if (edge.boundary == boundary) edges.insert(ascending(edge.vertices));
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    for (int side = 0; side < mesh::corner_count(mesh_.shape); ++side) {
      const auto corners = mesh::side_corners(mesh_.shape, side);
      const auto& vertices = mesh_.cells[c].vertices;
      if (!edges.contains(ascending(
              {vertices[static_cast<std::size_t>(corners[0])], vertices[static_cast<std::size_t>(corners[1])]})))
        continue;
      for (const int place : mesh::side_nodes(mesh_.shape, patch(c).order, side))
        nodes.insert(patch(c).nodes[static_cast<std::size_t>(place)]);
    }
  if (nodes.empty()) return;
  const Vector3d begin = position(*nodes.begin());
  const auto distance = [&](std::int32_t node) { return (position(node) - begin).norm(); };
  const Vector3d along = position(*std::ranges::max_element(nodes, {}, distance)) - begin;
  const bool is_straight = std::ranges::all_of(nodes, [&](std::int32_t node) {
    return along.cross(position(node) - begin).norm() <= straight * along.squaredNorm();
  });
  if (!is_straight) symmetric_.insert(edges.begin(), edges.end());
}

geometry::Frame SecondSurface::frame(std::size_t cell, const Vector2d& xi) const {
  geometry::PlaneJet at;
  at.value = xi;
  at.d = {Vector2d::UnitX(), Vector2d::UnitY()};
  return old_.frame(mesh_.cells[cell].patch, at);
}

FitPlane SecondSurface::plane_of(std::size_t cell) const {
  const geometry::Frame middle = frame(cell, mesh::centre(mesh_.shape));
  Vector3d normal = Vector3d::Zero();
  for (const std::int32_t node : patch(cell).nodes) normal += old_.directors[static_cast<std::size_t>(node)];
  normal.normalize();
  FitPlane plane{.origin = middle.phi, .axes = {}};
  plane.axes.col(2) = normal;
  plane.axes.col(0) = geometry::tangential(middle.a_cov[0], normal).normalized();
  plane.axes.col(1) = normal.cross(plane.axes.col(0));
  return plane;
}

std::set<std::int32_t> SecondSurface::stencil(std::size_t cell, const FitPlane& plane, int without) const {
  const auto& vertices = mesh_.cells[cell].vertices;
  std::set<int> left;  // vertices on the side that is left out
  if (without >= 0)
    for (const int k : mesh::side_corners(mesh_.shape, without)) left.insert(vertices[static_cast<std::size_t>(k)]);
  std::set<std::size_t> cells{cell};
  for (int k = 0; k < mesh::corner_count(mesh_.shape); ++k) {
    const int vertex = vertices[static_cast<std::size_t>(k)];
    if (left.contains(vertex)) continue;
    const auto& around = cells_at_.at(vertex);
    cells.insert(around.begin(), around.end());
  }
  std::set<std::int32_t> all;
  for (const std::size_t one : cells) {
    const Nodes& nodes = patch(one).nodes;
    const bool is_steep = std::ranges::any_of(nodes, [&](std::int32_t node) {
      return old_.directors[static_cast<std::size_t>(node)].dot(plane.axes.col(2)) < least_cosine;
    });
    if (!is_steep) all.insert(nodes.begin(), nodes.end());
  }
  return all;
}

std::optional<CellFit> SecondSurface::fit_nodes(const std::set<std::int32_t>& nodes, FitPlane plane, int order) const {
  plane.scale = 0;
  for (const std::int32_t node : nodes) plane.scale = std::max(plane.scale, (position(node) - plane.origin).norm());
  std::vector<Vector3d> points;
  points.reserve(nodes.size());
  for (const std::int32_t node : nodes) points.push_back(plane.local(position(node)));
  for (int degree = std::min(order + most_more, highest_fit); degree > order; --degree) {
    if (HeightFit::coefficient_count(degree) > used_share * static_cast<double>(nodes.size())) continue;
    HeightFit heights(points, degree);
    if (heights.is_determined()) return CellFit{.plane = plane, .heights = std::move(heights)};
  }
  return {};
}

double SecondSurface::correction(std::size_t cell, const CellFit& fit) const {
  double largest = 0;
  for (const Vector2d& xi : mesh::lattice(mesh_.shape, order_))
    largest = std::max(largest, std::abs(fit.lift(frame(cell, xi).phi)));
  return largest;
}

Vector3d SecondSurface::interpolated(std::size_t cell, int order, const Vector2d& xi) const {
  const mesh::LatticeValues basis = mesh::lattice_values(mesh_.shape, order, xi);
  const std::vector<Vector2d> nodes = mesh::lattice(mesh_.shape, order);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sum += basis.value[static_cast<Eigen::Index>(k)] * frame(cell, nodes[k]).phi;
  return sum;
}

double SecondSurface::bend(std::size_t cell, int order) const {
  double largest = 0;
  if (order > 1) {
    for (const Vector2d& xi : mesh::lattice(mesh_.shape, order))
      largest = std::max(largest, (interpolated(cell, order, xi) - interpolated(cell, order - 1, xi)).norm());
    return largest;
  }
  for (const std::int32_t a : patch(cell).nodes)  // an arc whose normals at its ends are the directors
    for (const std::int32_t b : patch(cell).nodes) {
      const Vector3d turn = old_.directors[static_cast<std::size_t>(a)] - old_.directors[static_cast<std::size_t>(b)];
      largest = std::max(largest, std::abs((position(a) - position(b)).dot(turn)) / 8);
    }
  return largest;
}

/// Fits the cell's nodes with those of all its neighbours, or of those on three sides, and takes the fit with the smallest
/// correction: beside a jump of the curvature, a fit across it finds a correction that is none.
std::optional<CellFit> SecondSurface::fit(std::size_t cell) const {
  const FitPlane plane = plane_of(cell);
  const double most = (patch(cell).order == 1 ? most_of_sag : most_of_bend) * bend(cell, patch(cell).order);
  std::optional<CellFit> best;
  double least = std::numeric_limits<double>::infinity();
  for (int without = -1; without < mesh::corner_count(mesh_.shape); ++without) {
    const auto nodes = stencil(cell, plane, without);
    auto found = fit_nodes(nodes, plane, patch(cell).order);
    if (!found) continue;
    double misfit = 0;
    for (const std::int32_t node : nodes) misfit = std::max(misfit, std::abs(found->lift(position(node))));
    const double change = correction(cell, *found);
    const bool is_flat = std::max(misfit, change) <= no_correction;
    const bool fits = is_flat || (misfit <= fitting * change && change * found->plane.scale <= most);
    if (!fits || change * found->plane.scale >= least) continue;
    least = change * found->plane.scale;
    best = std::move(found);
  }
  return best;
}

SecondSurface::Key SecondSurface::key(std::size_t cell, const Vector2d& xi, int number) const {
  constexpr double rounding = 1e-9;
  const mesh::CoarseCell& at = mesh_.cells[cell];
  for (int side = 0; side < mesh::corner_count(mesh_.shape); ++side) {
    const auto corners = mesh::side_corners(mesh_.shape, side);
    const Vector2d begin = mesh::corner(mesh_.shape, corners[0]), end = mesh::corner(mesh_.shape, corners[1]);
    const double t = (xi - begin).dot(end - begin) / (end - begin).squaredNorm();
    if ((begin + t * (end - begin) - xi).norm() > rounding) continue;
    const std::array<int, 2> ends{at.vertices[static_cast<std::size_t>(corners[0])],
                                  at.vertices[static_cast<std::size_t>(corners[1])]};
    const int k = static_cast<int>(std::lround(t * order_));
    if (k == 0) return {ends[0], -1, 0};
    if (k == order_) return {ends[1], -1, 0};
    return ends[0] < ends[1] ? Key{ends[0], ends[1], k} : Key{ends[1], ends[0], order_ - k};
  }
  return {-1, static_cast<int>(cell), number};
}

bool SecondSurface::is_kept(const Key& key) const {
  if (key[0] >= 0 && key[1] < 0) return fold_vertices_.contains(key[0]);
  return key[0] >= 0 && folds_.contains({key[0], key[1]});
}

NewNode SecondSurface::moved(std::size_t cell, const CellFit& fit, const Key& key, const Vector2d& xi) const {
  const geometry::Frame before = frame(cell, xi);
  const Vector3d at = fit.plane.local(before.phi);
  const double lift = fit.lift(before.phi);
  if (is_kept(key) || std::abs(lift) <= no_correction) return {before.phi, before.a3};
  NewNode node{.position = before.phi + lift * fit.plane.scale * fit.plane.axes.col(2),
               .director = (fit.plane.axes * fit.heights.normal(at[0], at[1])).normalized()};
  for (const Edge& edge : symmetric_) {
    const auto& vertices = mesh_.cells[cell].vertices;
    const bool is_own = std::ranges::count(vertices, edge[0]) > 0 && std::ranges::count(vertices, edge[1]) > 0;
    const bool is_on = key[1] < 0 ? key[0] == edge[0] || key[0] == edge[1] : key[0] == edge[0] && key[1] == edge[1];
    if (is_own && is_on) put_into_plane(cell, edge, before, node);
  }
  return node;
}

void SecondSurface::put_into_plane(std::size_t cell, const Edge& edge, const geometry::Frame& before,
                                   NewNode& node) const {
  for (int side = 0; side < mesh::corner_count(mesh_.shape); ++side) {
    const auto corners = mesh::side_corners(mesh_.shape, side);
    const auto& vertices = mesh_.cells[cell].vertices;
    if (ascending({vertices[static_cast<std::size_t>(corners[0])], vertices[static_cast<std::size_t>(corners[1])]}) !=
        edge)
      continue;
    const Vector2d along = mesh::corner(mesh_.shape, corners[1]) - mesh::corner(mesh_.shape, corners[0]);
    const Vector3d tangent = along[0] * before.a_cov[0] + along[1] * before.a_cov[1];
    const Vector3d across = tangent.cross(before.a3).normalized();
    node.position -= (node.position - before.phi).dot(across) * across;
    node.director = (node.director - node.director.dot(across) * across).normalized();
  }
}

void SecondSurface::add(std::size_t cell, const Vector2d& xi, int number, const std::optional<CellFit>& fit) {
  const Key place = key(cell, xi, number);
  const geometry::Frame before = frame(cell, xi);
  const NewNode node = fit ? moved(cell, *fit, place, xi) : NewNode{before.phi, before.a3};
  const auto [found, is_new] = sums_.try_emplace(
      place, Sum{before.phi, Vector3d::Zero(), Vector3d::Zero(), 0, static_cast<std::int32_t>(sums_.size())});
  found->second.position += node.position;
  found->second.director += node.director;
  ++found->second.count;
  nodes_of_[cell].push_back(found->second.node);
}

void SecondSurface::add_cells(SurfaceComparison& comparison) {
  double area = 0, judged = 0;
  nodes_of_.resize(mesh_.cells.size());
  const std::vector<Vector2d> points = mesh::lattice(mesh_.shape, order_);
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    const auto found = is_fitted() ? fit(c) : std::nullopt;
    const geometry::Frame middle = frame(c, mesh::centre(mesh_.shape));
    const double share = middle.a_cov[0].cross(middle.a_cov[1]).norm();
    area += share;
    if (found || !is_fitted()) judged += share;
    for (std::size_t p = 0; p < points.size(); ++p) add(c, points[p], static_cast<int>(p), found);
  }
  comparison.judged_share = judged / area;
}

/// Sets the decay of the bends from order to order, and the deviation that follows after the last order.
void SecondSurface::judge_decay(SurfaceComparison& comparison) const {
  double last = 0, before = 0;
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    const double own = bend(c, highest_order());
    before = std::max(before, bend(c, highest_order() - 1));
    if (own > last) comparison.place = frame(c, mesh::centre(mesh_.shape)).phi;
    last = std::max(last, own);
  }
  comparison.decay = before > 0 ? std::min(1.0, last / before) : 0;
  comparison.deviation = comparison.decay * last;
}

SurfaceComparison SecondSurface::run() {
  SurfaceComparison comparison;
  add_cells(comparison);
  auto patches = std::make_shared<mesh::SurfacePatches>();
  patches->shape = old_.shape;
  patches->axes = old_.axes;
  patches->positions.resize(sums_.size());
  patches->directors.resize(sums_.size());
  for (const auto& [place, sum] : sums_) {
    const auto node = static_cast<std::size_t>(sum.node);
    patches->positions[node] = sum.position / sum.count;
    patches->directors[node] = sum.director / sum.count;
    const double distance = (patches->positions[node] - sum.before).norm();
    if (distance <= comparison.deviation) continue;
    comparison.deviation = distance;
    comparison.place = sum.before;
  }
  patches->patches.resize(old_.patches.size());
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
    patches->patches[static_cast<std::size_t>(mesh_.cells[c].patch)] = {order_, nodes_of_[c]};
  comparison.patches = std::move(patches);
  if (!is_fitted()) judge_decay(comparison);
  return comparison;
}

}  // namespace

SurfaceComparison compared_surface(const mesh::CoarseMesh& mesh, const std::vector<std::string>& symmetric) {
  return SecondSurface(mesh, symmetric).run();
}

}  // namespace plastron::topology
