#include <plastron/meshing/start_mesh.hpp>

#include <plastron/domain/domain.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/meshing/constants.hpp>
#include <plastron/meshing/imperfections.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace plastron::meshing {

namespace {

using Eigen::Vector2d;

/// Space for rows along a boundary, in Omega.
struct Room {
  const EdgeLayer& layer;
  double operator()(const domain::Rectangle& r) const {
    if (layer.boundary >= 2) return r.to[1] - r.from[1];
    const auto& breaks = r.breaks;
    if (breaks.empty()) return r.to[0] - r.from[0];
    return layer.boundary == 0 ? breaks.front() - r.from[0] : r.to[0] - breaks.back();
  }
  double operator()(const domain::Disk& d) const { return d.radius; }
  double operator()(const domain::Annulus& a) const { return a.outer - a.inner; }
  double operator()(const domain::Polygon& polygon) const { return domain::inner_width(polygon); }
  double operator()(const domain::MeshFile&) const { return 0; }
};

/// Returns boundaries beyond which the shell continues: there is no edge.
std::set<int> boundaries_within(const problem::Problem& problem) {
  const auto names = domain::boundary_names(problem.domain);
  std::set<int> result;
  const auto add = [&](const std::string& name) {
    const auto place = std::ranges::find(names, name);
    if (place != names.end()) result.insert(static_cast<int>(place - names.begin()));
  };
  for (const assembly::Support& support : problem.shell.supports)
    if (support.symmetry) add(support.boundary);
  for (const fem::Join& join : problem.joins)
    for (const std::string& name : join.boundaries) add(name);
  return result;
}

/// Whether joined edges stay equal for any rows of the other edges: opposite sides of a rectangle.
bool keeps_joins_alike(const problem::Problem& problem) {
  if (problem.joins.empty()) return true;
  const std::set<std::string> pair(problem.joins[0].boundaries.begin(), problem.joins[0].boundaries.end());
  return problem.joins.size() == 1 && std::holds_alternative<domain::Rectangle>(problem.domain) &&
         (pair == std::set<std::string>{"left", "right"} || pair == std::set<std::string>{"bottom", "top"});
}

/// Whether each row needs a second, narrow row between it and the edge. Rows cross at corners of four-sided domains.
/// Narrow rows are useful if the required accuracy exceeds the accuracy of the corners' cells, at one degree. `share` is
/// the widest row's part of the domain's width.
bool wants_narrow_rows(const problem::Problem& problem, double share) {
  if (!problem.accuracy || problem.discretisation.degree != constants.narrow_row_degree) return false;
  const auto* polygon = std::get_if<domain::Polygon>(&problem.domain);
  if (!std::holds_alternative<domain::Rectangle>(problem.domain) &&
      !(polygon && domain::is_convex_quadrilateral(*polygon)))
    return false;
  return std::ranges::any_of(problem.accuracy->goals, [&](const problem::Accuracy::Goal& goal) {
    return goal.tolerance <= constants.corner_error * share * share;
  });
}

/// Returns the rows of each boundary and their layers. A boundary has rows in all its regions or in none.
std::pair<Rows, std::vector<EdgeLayer>> rows_of(const problem::Problem& problem) {
  Rows rows;
  std::vector<EdgeLayer> kept;
  const auto within = boundaries_within(problem);
  const auto boundaries = static_cast<int>(domain::boundary_names(problem.domain).size());
  const auto layers = edge_layers(problem);
  double share = 0;  // share of the widest row
  for (int b = 0; b < boundaries; ++b) {
    std::vector<std::vector<double>> distances;
    bool fits = false;
    for (const EdgeLayer& layer : layers)
      if (layer.boundary == b) {
        const double most = constants.largest_row * std::visit(Room{layer}, problem.domain);
        const double row = constants.row_width * layer.width_in_omega;
        if (row <= most && !within.contains(b)) {
          fits = true;
          share = std::max(share, row / most * constants.largest_row);
          kept.push_back(layer);
        }
        distances.push_back({row <= most ? row : most});
      }
    if (!fits) std::ranges::fill(distances, std::vector<double>{});
    rows.distances.push_back(std::move(distances));
  }
  // Joined edges, which may be reversed, meet the rows of both neighbours.
  if (!problem.joins.empty()) {
    auto& a = within.contains(0) ? rows.distances[2] : rows.distances[0];
    auto& b = within.contains(0) ? rows.distances[3] : rows.distances[1];
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
      for (std::size_t k = 0; k < std::min(a[i].size(), b[i].size()); ++k)
        a[i][k] = b[i][k] = std::min(a[i][k], b[i][k]);
  }
  if (wants_narrow_rows(problem, share))
    for (auto& regions : rows.distances)
      for (auto& distances : regions)
        if (!distances.empty())
          distances.insert(distances.begin(), distances.front() * constants.narrow_row_width / constants.row_width);
  return {std::move(rows), std::move(kept)};
}

bool has_narrow_rows(const Rows& rows) {
  return std::ranges::any_of(rows.distances,
                             [](const auto& regions) { return !regions.empty() && regions.front().size() > 1; });
}

/// Returns the size of cells between the rows on the finest mesh [m].
double size_inside(const problem::Problem& problem, const Interior& inside) {
  const int degree = problem.discretisation.degree;
  double size = constants.cell_size * degree * inside.width;
  if (!problem.shell.obstacles.empty() && !problem.accuracy)
    size = std::min(size, degree * std::sqrt(inside.area / constants.contact_nodes));
  return size;
}

double last_or_nothing(const std::vector<std::vector<double>>& distances) {
  return distances.front().empty() ? 0 : distances.front().back();
}

/// Number of cells between the rows, in the form of fem::Rows, for a cell size in metres.
struct InnerCells {
  const Rows& rows;
  const Interior& inside;
  double size;

  int count(double length) const {
    const double cells = std::ceil(length / size - constants.excess_size);
    if (!(cells > 1)) return 1;  // also where the chart has almost no curvature
    return static_cast<int>(std::min(cells, 1.0 * constants.most_cells_across));
  }
  std::array<int, 2> operator()(const domain::Rectangle& r) const {
    const Vector2d taken(last_or_nothing(rows.distances[0]) + last_or_nothing(rows.distances[1]),
                         last_or_nothing(rows.distances[2]) + last_or_nothing(rows.distances[3]));
    const Vector2d length = (r.to - r.from - taken).cwiseProduct(inside.stretch);
    return {std::max(r.cells[0], count(length[0])), std::max(r.cells[1], count(length[1]))};
  }
  /// A disk has 5 m^2 cells of about the same area.
  std::array<int, 2> operator()(const domain::Disk&) const {
    const int m = count(std::sqrt(inside.area / 5));
    return {m, m};
  }
  std::array<int, 2> operator()(const domain::Annulus& a) const {
    const double stretch = inside.stretch.mean();
    const int around = 2 * count(std::numbers::pi * (a.inner + a.outer) / 2 * stretch);
    const double between = a.outer - a.inner - last_or_nothing(rows.distances[0]) - last_or_nothing(rows.distances[1]);
    return {std::max(6, around), count(between * stretch)};
  }
  std::array<int, 2> operator()(const domain::Polygon& polygon) const {
    const auto& p = polygon.corners;
    const double stretch = inside.stretch.mean();
    if (!domain::is_convex_quadrilateral(polygon)) {
      const int along = count(domain::perimeter(polygon) / 2 * stretch);
      return {along, along};
    }
    const auto side = [&](std::size_t i) { return (p[(i + 1) % 4] - p[i]).norm(); };
    return {count((side(0) + side(2)) / 2 * stretch), count((side(1) + side(3)) / 2 * stretch)};
  }
  std::array<int, 2> operator()(const domain::MeshFile&) const { return {1, 1}; }
};

/// Adds rings outside the middle of a disk whose chords may be cut.
void add_rings(const problem::Problem& problem, const InnerCells& cells, Rows& rows) {
  const auto* disk = std::get_if<domain::Disk>(&problem.domain);
  if (!disk || !problem.accuracy || is_refined_evenly(problem) || problem.discretisation.degree > constants.ring_degree)
    return;
  const double core = constants.ring_core * disk->radius;
  const double between = disk->radius - last_or_nothing(rows.distances[0]) - core;  // rows take at most a quarter
  rows.core = core;
  rows.rings = cells.count(between * cells.inside.stretch.mean());
  rows.inner[1] = std::max(1, rows.inner[1] / 2);
}

/// Returns a size that gives at least two cells along the longer side on the finest mesh. One cell is too coarse at any
/// degree.
double largest_cell(const Interior& inside) { return std::sqrt(inside.area) / 2; }

/// Whether all fixed points are nodes.
bool has_points(const mesh::CoarseMesh& coarse, const problem::Problem& problem) {
  const auto nodes = mesh::kept_nodes(coarse, problem.discretisation.degree);
  const double tolerance = mesh::point_tolerance(coarse);
  return std::ranges::all_of(problem.shell.supports, [&](const assembly::Support& s) {
    return !s.point ||
           std::ranges::any_of(nodes, [&](const Vector2d& x) { return (x - *s.point).norm() <= tolerance; });
  });
}

}  // namespace

bool is_refined_evenly(const problem::Problem& problem) {
  return problem.accuracy->is_uniform || problem.discretisation.cells == mesh::Shape::triangle;
}

namespace {

StartMesh perfect_mesh(const problem::Problem& problem) {
  const problem::Discretisation& d = problem.discretisation;
  const auto plain = [&](const std::string& why) {
    return StartMesh{.coarse = domain::coarse_mesh(problem.domain, d.cells), .rows = {}, .no_rows = why};
  };
  if (d.layers == problem::Layers::none) return plain("");
  if (std::holds_alternative<domain::MeshFile>(problem.domain)) return plain("a mesh that is read is left as it is");
  if (!keeps_joins_alike(problem)) return plain("joined edges must have the same cells on both sides");
  auto [rows, layers] = rows_of(problem);
  const Interior inside = interior(problem);
  const double size = std::min(size_inside(problem, inside), largest_cell(inside)) * std::exp2(d.refinements);
  const InnerCells cells{rows, inside, size};
  rows.inner = std::visit(cells, problem.domain);
  add_rings(problem, cells, rows);
  StartMesh mesh{.coarse = {}, .rows = std::move(layers), .has_narrow_rows = has_narrow_rows(rows)};
  try {
    mesh.coarse = layered_mesh(problem.domain, d.cells, rows);
  } catch (const mesh::DomainError& error) {
    return plain(error.what());
  }
  if (!has_points(mesh.coarse, problem)) return plain("points that are held would be no nodes");
  return mesh;
}

}  // namespace

StartMesh start_mesh(const problem::Problem& problem) {
  StartMesh mesh = perfect_mesh(problem);
  mesh.coarse.shifts = shifts_of(problem, mesh.coarse);
  return mesh;
}

int recommended_degree(const problem::Problem& problem) {
  if (problem.discretisation.cells == mesh::Shape::triangle) return constants.degree_of_triangles;
  return problem.shell.obstacles.empty() ? constants.degree_smooth : constants.degree_with_contact;
}

std::int64_t node_count(const mesh::CoarseMesh& coarse, int degree, int refinements) {
  std::set<std::pair<int, int>> sides;
  for (const mesh::CoarseCell& cell : coarse.cells)
    for (int side = 0; side < mesh::corner_count(coarse.shape); ++side) {
      const auto [from, to] = mesh::side_corners(coarse.shape, side);
      sides.insert(std::minmax(cell.vertices[from], cell.vertices[to]));
    }
  // A refined cell has the nodes of one cell of degree n.
  const std::int64_t n = static_cast<std::int64_t>(degree) << refinements;
  const bool is_triangle = coarse.shape == mesh::Shape::triangle;
  const std::int64_t in_cell = is_triangle ? (n - 1) * (n - 2) / 2 : (n - 1) * (n - 1);
  std::set<int> vertices;
  for (const mesh::CoarseCell& cell : coarse.cells)
    for (const int v : cell.vertices)
      if (v >= 0) vertices.insert(v);
  return static_cast<std::int64_t>(vertices.size()) + static_cast<std::int64_t>(sides.size()) * (n - 1) +
         static_cast<std::int64_t>(coarse.cells.size()) * in_cell;
}

std::string describe(const StartMesh& mesh, const problem::Problem& problem) {
  const problem::Discretisation& d = problem.discretisation;
  if (d.layers == problem::Layers::none) return "";
  const int width = element::is_relaxed(problem.shell.tangency.formulation) ? 6 : 5;
  const auto unknowns = [&](int refinements) { return width * node_count(mesh.coarse, d.degree, refinements); };
  const auto names = domain::boundary_names(problem.domain), regions = domain::region_names(problem.domain);
  std::vector<std::string> rows;
  for (const EdgeLayer& layer : mesh.rows) {
    const std::string& region = regions[layer.region];
    rows.push_back(fmt::format("{}{} {:.3g} m", names[layer.boundary], region.empty() ? "" : " of " + region,
                               constants.row_width * layer.width));
  }
  const std::string what = !mesh.no_rows.empty() ? fmt::format("no rows along edges: {}", mesh.no_rows)
                           : rows.empty()
                               ? "edge refinement: not needed (edge layers are absent or wider than a quarter of the "
                                 "shell)"
                               : fmt::format("rows along {} wide{}", fmt::join(rows, ", "),
                                             mesh.has_narrow_rows ? ", and a narrow one at each of these edges" : "");
  const std::string finest =
      d.refinements == 0 ? "" : fmt::format(", {} after {} refinements", unknowns(d.refinements), d.refinements);
  const int degree = recommended_degree(problem);
  constexpr std::int64_t many = 500'000;  // minutes on two cores, and finer meshes follow
  const bool is_large = problem.accuracy && d.degree > 2 && unknowns(0) > many;
  const std::string advice =
      is_large ? fmt::format(
                     "; this is a large first mesh: cells of degree {} may be as large as the part's details, "
                     "or write degree = 2 in [mesh] beside [accuracy]",
                     d.degree)
      : problem.accuracy || degree == d.degree ? ""
                                               : fmt::format("; degree {} is recommended", degree);
  return fmt::format("{}; {} cells, {} unknowns of degree {}{}{}", what, mesh.coarse.cells.size(), unknowns(0),
                     d.degree, finest, advice);
}

}  // namespace plastron::meshing
