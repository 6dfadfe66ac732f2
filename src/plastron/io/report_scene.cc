#include <plastron/io/report_scene.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/fem/reference_cell.hpp>
#include <plastron/io/base64.hpp>
#include <plastron/io/obstacle_surfaces.hpp>
#include <plastron/io/report_surface.hpp>
#include <plastron/io/thinned_surface.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace plastron::io {

namespace {

static_assert(std::endian::native == std::endian::little, "the page holds little-endian numbers");

template <class Number>
std::string array_text(const std::vector<Number>& values) {
  return base64(std::as_bytes(std::span(values.data(), values.size())));
}

Json row_json(const std::vector<float>& row) {
  const bool is_constant = !row.empty() && std::ranges::all_of(row, [&](float value) { return value == row.front(); });
  return is_constant ? number(row.front()) : Json(array_text(row));
}

Json fields_json(const SampledSurface& surface, const problem::UnitNames& units) {
  Json list = Json::array();
  std::size_t row = 0;
  for (const Field& field : surface.fields) {
    Json values = Json::array();
    for (int c = 0; c < field.components; ++c) values.push_back(row_json(surface.rows[row++]));
    list.push_back({{"key", field.key},
                    {"arrays", field.arrays},
                    {"symbol", field.symbol},
                    {"unit", units.label(field.unit)},
                    {"meaning", field.meaning},
                    {"values", std::move(values)}});
  }
  return list;
}

void append(const Eigen::Vector3d& v, std::vector<float>& numbers) {
  for (const double value : v) numbers.push_back(static_cast<float>(value));
}

Json obstacle_json(const obstacle::TriangleMesh& mesh, const std::string& name) {
  std::vector<float> points;
  for (const Eigen::Vector3d& p : mesh.points) append(p, points);
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles)
    for (const auto corner : triangle) corners.push_back(static_cast<std::uint32_t>(corner));
  return {{"name", name}, {"points", array_text(points)}, {"triangles", array_text(corners)}};
}

Json obstacles_json(const assembly::RigidObstacles& obstacles, const obstacle::Extent& extent,
                    const solution::Summary& summary) {
  constexpr std::size_t most_triangles = 60'000;  // in total: 1.3 MB
  Json list = Json::array();
  const auto all = drawn_obstacles(obstacles, extent);
  for (const DrawnObstacle& drawn : all)
    list.push_back(obstacle_json(thinned_surface(drawn.surface, most_triangles / all.size()),
                                 summary.obstacles.at(drawn.number).name));
  return list;
}

Json lines_json(const solution::Summary& summary) {
  Json list = Json::array();
  for (std::size_t o = 0; o < summary.obstacles.size(); ++o)
    for (const solution::ContactZone& zone : summary.obstacles[o].zones)
      for (const solution::ContactLine& line : zone.lines) {
        std::vector<float> points, displacements;
        for (const solution::BoundaryPoint& p : line.points) {
          append(p.place, points);
          append(p.displacement, displacements);
        }
        list.push_back({{"obstacle", o},
                        {"rim", line.is_rim},
                        {"points", array_text(points)},
                        {"displacements", array_text(displacements)}});
      }
  return list;
}

/// Returns sides of cells on boundaries with supports: a polyline of nodes for each, with the name of the boundary
/// (collective).
Json supports_json(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  const fem::Space& space = discrete.space();
  const auto& names = space.coarse->boundaries;
  const auto is_supported = [&](int boundary) {
    return boundary >= 0 && std::ranges::find(discrete.supports, names[static_cast<std::size_t>(boundary)],
                                              &assembly::Support::boundary) != discrete.supports.end();
  };
  const std::size_t nodes = static_cast<std::size_t>(space.degree) + 1, size = 1 + 6 * nodes;
  std::vector<double> mine;
  for (const fem::BoundarySide& side : space.sides) {
    if (side.cell >= space.owned_cells || !is_supported(side.boundary)) continue;
    mine.push_back(side.boundary);
    for (const int k : fem::side_nodes(space.shape(), space.degree, side.side)) {
      const auto node = static_cast<std::size_t>(space.connectivity.element(side.cell)[static_cast<std::size_t>(k)]);
      const auto& phi = discrete.points[node].phi;
      mine.insert(mine.end(), phi.begin(), phi.end());
      for (std::size_t d = 0; d < 3; ++d) mine.push_back(solution.y.local()[6 * node + d]);
    }
  }
  const std::vector<double> all = algebra::gather_over_ranks(mine, space.layout->comm);
  std::vector<std::vector<double>> sides;
  for (std::size_t at = 0; at < all.size(); at += size)
    sides.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(at),
                       all.begin() + static_cast<std::ptrdiff_t>(at + size));
  std::ranges::sort(sides);
  Json list = Json::array();
  for (const std::vector<double>& side : sides) {
    std::vector<float> points, displacements;
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t d = 0; d < 3; ++d) {
        points.push_back(static_cast<float>(side[1 + 6 * k + d]));
        displacements.push_back(static_cast<float>(side[4 + 6 * k + d]));
      }
    list.push_back({{"boundary", names[static_cast<std::size_t>(side.front())]},
                    {"points", array_text(points)},
                    {"displacements", array_text(displacements)}});
  }
  return list;
}

}  // namespace

Json scene_json(const computation::Solution& solution, const solution::Summary& summary,
                const problem::UnitNames& units, std::int64_t most_points) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const fem::Space& space = discrete.space();
  const SampledSurface surface = sampled_surface(solution, most_points);
  const obstacle::Extent extent = surroundings(solution);
  const Json supports = supports_json(discrete, solution.nodal);
  int rank = 0;
  MPI_Comm_rank(space.layout->comm, &rank);
  return algebra::in_agreement(space.layout->comm, [&] {
    if (rank != 0 || surface.rows.empty()) return Json(nullptr);
    return Json{{"shape", space.shape() == fem::Shape::triangle ? "triangle" : "quadrilateral"},
                {"subdivisions", surface.cells.subdivisions},
                {"cells", surface.cells.count},
                {"points", surface.points},
                {"mesh_cells", space.global_cells},
                {"degree", space.degree},
                {"merged", 1 << surface.cells.merged_levels},
                {"fields", fields_json(surface, units)},
                {"obstacles", obstacles_json(discrete.obstacles, extent, summary)},
                {"lines", lines_json(summary)},
                {"supports", supports}};
  });
}

}  // namespace plastron::io
