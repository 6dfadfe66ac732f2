#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/fem/cut_mesh.hpp>
#include <plastron/io/bytes.hpp>
#include <plastron/io/obstacle_surfaces.hpp>
#include <plastron/mesh/reference_cell.hpp>
#include <plastron/report/load_arrows.hpp>
#include <plastron/report/report_scene.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace plastron::report {

namespace {

/// Largest number of modes times points on a page: 3 MB.
constexpr std::int64_t most_mode_points = 190'000;

/// Identity of a point: coarse cell, place of its drawn cell in it, number in the drawn cell.
using Key = std::array<std::int64_t, 4>;

/// A drawn cell: the key of its first point, and DrawnPlace as numbers.
struct PlacedCell {
  Key key;
  std::array<double, 5> place;
};

struct PointRecords {
  std::vector<Key> keys{};
  std::vector<float> values{};  ///< for each key one value per row
  std::vector<PlacedCell> cells{};
};

std::int64_t points_in(mesh::Shape shape, int subdivisions) { return mesh::nodes_per_cell(shape, subdivisions); }

/// A block of finest cells, 2^merged on each side, that contains a cell, or the cell itself if it is larger. Its
/// coordinates refer to the coarse cell, as in fem::Cell.
struct Block {
  Key key;
  fem::Cell cell;
};

Block block_of(const fem::Cell& cell, mesh::Shape shape, const DrawnCells& drawn) {
  const double finest = std::ldexp(1.0, -drawn.levels);
  const double size = std::max(std::abs(cell.size), std::ldexp(finest, drawn.merged_levels));
  const Eigen::Vector2d middle = (cell.corner + cell.size * mesh::centre(shape)) / size;
  const Eigen::Vector2d low(std::floor(middle[0]), std::floor(middle[1]));
  const bool is_turned = shape == mesh::Shape::triangle && (middle - low).sum() > 1;
  const Eigen::Vector2d corner = is_turned ? (low + Eigen::Vector2d::Ones()).eval() : low;
  const auto place = [&](double multiple) { return static_cast<std::int64_t>(multiple * size / finest); };
  return {{cell.coarse, place(low[1]), 2 * place(low[0]) + (is_turned ? 1 : 0), 0},
          {.coarse = cell.coarse, .corner = size * corner, .size = is_turned ? -size : size}};
}

/// Whether corner k of the cell is corner k of its block.
bool is_blocks_corner(const fem::Cell& cell, const fem::Cell& block, mesh::Shape shape, int k) {
  const Eigen::Vector2d corner = mesh::corner(shape, k);
  const Eigen::Vector2d distance = cell.corner + cell.size * corner - block.corner - block.size * corner;
  return distance.norm() < 0.25 * std::abs(cell.size);
}

/// Returns the least pressure at a node, or 0: between nodes polynomials have lower values.
double least_pressure(const computation::Solution& solution) {
  double least = 0;
  const auto owned = static_cast<std::size_t>(solution.discrete->space().layout->owned);
  for (std::size_t i = 0; i < owned; ++i) least = std::min(least, solution::total_pressure(solution.nodal, i));
  return algebra::min_over_ranks(least, solution.discrete->space().layout->comm);
}

void append(recovery::PointValues point, double least_pressure, const std::vector<Field>& fields,
            std::vector<float>& values) {
  if (point.pressure < least_pressure) point.pressure = least_pressure;
  for (const Field& field : fields) {
    const auto taken = field.take(point);
    for (int c = 0; c < field.components; ++c) values.push_back(static_cast<float>(taken[static_cast<std::size_t>(c)]));
  }
}

PlacedCell placed(const Block& block, const std::vector<fem::CutCell>& cuts) {
  const fem::CutCell& cut = cuts[static_cast<std::size_t>(block.cell.coarse)];
  const Eigen::Vector2d corner = cut.corner + cut.size.cwiseProduct(block.cell.corner),
                        size = block.cell.size * cut.size;
  return {block.key, {static_cast<double>(cut.first), corner[0], corner[1], size[0], size[1]}};
}

/// Returns the points from cells of this rank: the values of the fields, then the displacements of the modes.
PointRecords own_points(const computation::Solution& solution, const DrawnCells& drawn, double least_pressure,
                        const std::vector<Field>& fields, std::span<const computation::Mode> modes) {
  const fem::Space& space = solution.discrete->space();
  const mesh::Shape shape = space.shape();
  PointRecords records;
  if (space.owned_cells == 0) return records;
  const auto lattice = mesh::lattice(shape, drawn.subdivisions);
  const recovery::Recovery recovery(*solution.discrete, solution.nodal, lattice, solution.recovery);
  const energy::ShellOperator& shell = solution.discrete->shell;
  const element::BasisAt basis = element::basis_at(shape, space.degree, lattice);
  const int slots = static_cast<int>(points_in(shape, drawn.subdivisions));
  const std::vector<fem::CutCell> cuts = fem::cut_cells(*space.coarse);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    const Block block = block_of(space.cells[cell], shape, drawn);
    std::vector<int> wanted;
    for (int k = 0; k < slots; ++k)
      if (drawn.merged_levels == 0 || is_blocks_corner(space.cells[cell], block.cell, shape, k)) wanted.push_back(k);
    if (wanted.empty()) continue;
    const auto points = recovery(cell);
    std::vector<element::CellField> shapes;
    for (const computation::Mode& mode : modes)
      shapes.push_back(shell.interpolation().values(cell, basis, shell.gather(cell, mode.shape)));
    for (const int k : wanted) {
      records.keys.push_back(block.key);
      records.keys.back()[3] = k;
      if (k == 0) records.cells.push_back(placed(block, cuts));
      append(points[static_cast<std::size_t>(k)], least_pressure, fields, records.values);
      for (const element::CellField& values : shapes)
        for (Eigen::Index d = 0; d < 3; ++d) records.values.push_back(static_cast<float>(values(k, d)));
    }
  }
  return records;
}

/// Returns the values by rows, with points in the order of their keys.
std::vector<std::vector<float>> in_rows(const PointRecords& records) {
  const std::size_t points = records.keys.size();
  if (points == 0) return {};
  const std::size_t rows = records.values.size() / points;
  std::vector<std::size_t> order(points);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return records.keys[i]; });
  std::vector<std::vector<float>> result(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    result[row].reserve(points);
    for (const std::size_t i : order) result[row].push_back(records.values[i * rows + row]);
  }
  return result;
}

/// Returns the places of drawn cells in the order of their points.
std::vector<DrawnPlace> in_order(std::vector<PlacedCell> cells) {
  std::ranges::sort(cells, {}, &PlacedCell::key);
  std::vector<DrawnPlace> places;
  places.reserve(cells.size());
  for (const auto& [key, p] : cells) places.push_back({static_cast<std::size_t>(p[0]), {p[1], p[2]}, {p[3], p[4]}});
  return places;
}

/// Returns the number of cells on all ranks from coarse cells divided 0, 1, 2, ... times; the last ones are the finest.
std::vector<std::int64_t> cells_by_level(const fem::Space& space) {
  constexpr int most_levels = 64;
  std::vector<std::int64_t> counts(most_levels, 0);
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    ++counts.at(static_cast<std::size_t>(-std::ilogb(std::abs(space.cells[cell].size))));
  MPI_Allreduce(MPI_IN_PLACE, counts.data(), most_levels, MPI_INT64_T, MPI_SUM, space.layout->comm);
  while (counts.size() > 1 && counts.back() == 0) counts.pop_back();
  return counts;
}

}  // namespace

std::vector<Field> report_fields(const Ingredients& ingredients) {
  auto fields = io::fields_of(ingredients);
  std::erase_if(fields, [](const Field& field) {
    return field.key.starts_with("frame/t") || field.key.ends_with("_direction") || field.key.ends_with("_face");
  });
  return fields;
}

SampledSurface sampled_surface(const computation::Solution& solution, std::int64_t most_points,
                               std::vector<Field> fields, std::span<const computation::Mode> modes) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const fem::Space& space = discrete.space();
  const MPI_Comm comm = space.layout->comm;
  SampledSurface surface;
  surface.fields = std::move(fields);
  surface.cells = drawn_cells(space.shape(), space.degree, cells_by_level(space), most_points);
  if (surface.cells.count == 0) return surface;
  surface.points = surface.cells.count * points_in(space.shape(), surface.cells.subdivisions);
  const auto most_modes = static_cast<std::size_t>(most_mode_points / surface.points);
  surface.modes = modes.first(std::min(modes.size(), most_modes));
  const double least = least_pressure(solution);
  const PointRecords mine = algebra::in_agreement(
      comm, [&] { return own_points(solution, surface.cells, least, surface.fields, surface.modes); });
  constexpr auto first = algebra::Receivers::first_rank;
  const PointRecords all{algebra::gathered(mine.keys, comm, first), algebra::gathered(mine.values, comm, first),
                         algebra::gathered(mine.cells, comm, first)};
  surface.rows = in_rows(all);
  surface.drawing = {space.shape(), surface.cells.subdivisions, in_order(all.cells)};
  return surface;
}

namespace {

Json row_json(const std::vector<float>& row) {
  const bool is_constant = !row.empty() && std::ranges::all_of(row, [&](float value) { return value == row.front(); });
  return is_constant ? io::number(row.front()) : Json(io::base64_of_numbers(row));
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
  for (const computation::Mode& mode : surface.modes) {
    Json values = Json::array();
    for (int d = 0; d < 3; ++d) values.push_back(row_json(surface.rows[row++]));
    list.push_back(io::field_json(mode));
    list.back()["is_mode"] = true;
    list.back()["values"] = std::move(values);
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
  return {{"name", name}, {"points", io::base64_of_numbers(points)}, {"triangles", io::base64_of_numbers(corners)}};
}

Json obstacles_json(const std::vector<io::DrawnObstacle>& all, const solution::Summary& summary) {
  constexpr std::size_t most_triangles = 60'000;  // in total: 1.3 MB
  Json list = Json::array();
  for (const io::DrawnObstacle& drawn : all)
    list.push_back(obstacle_json(io::thinned_surface(drawn.surface, most_triangles / all.size()),
                                 summary.obstacles.at(drawn.number).name));
  return list;
}

/// Whether some contact zone has a pressure that does not depend on the mesh.
bool touches_on_areas(const solution::Summary& summary) {
  return std::ranges::any_of(summary.obstacles, [](const solution::ObstacleContact& obstacle) {
    return std::ranges::any_of(obstacle.zones, [](const solution::ContactZone& zone) { return !zone.is_line(); });
  });
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
                        {"points", io::base64_of_numbers(points)},
                        {"displacements", io::base64_of_numbers(displacements)}});
      }
  return list;
}

/// Whether a support of the boundary prevents the shell from turning about it.
bool is_clamped(const assembly::DiscreteShell& discrete, const std::string& boundary) {
  using assembly::Direction;
  const auto prevents = [](const assembly::PrescribedComponent& c) {
    return c.unknown == assembly::Unknown::rotation && c.direction != Direction::tangent &&
           c.direction != Direction::normal;
  };
  return std::ranges::any_of(discrete.supports, [&](const assembly::Support& support) {
    return support.boundary == boundary && std::ranges::any_of(support.components, prevents);
  });
}

/// Returns sides of cells on boundaries with supports: a polyline of nodes for each, with the name of the boundary and
/// whether it is clamped (collective).
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
    for (const int k : mesh::side_nodes(space.shape(), space.degree, side.side)) {
      const auto node = static_cast<std::size_t>(space.connectivity.element(side.cell)[static_cast<std::size_t>(k)]);
      const auto& phi = discrete.points[node].phi;
      mine.insert(mine.end(), phi.begin(), phi.end());
      for (std::size_t d = 0; d < 3; ++d) mine.push_back(solution.y.local()[6 * node + d]);
    }
  }
  const std::vector<double> all = algebra::gathered(mine, space.layout->comm);
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
    const std::string& boundary = names[static_cast<std::size_t>(side.front())];
    list.push_back({{"boundary", boundary},
                    {"clamped", is_clamped(discrete, boundary)},
                    {"points", io::base64_of_numbers(points)},
                    {"displacements", io::base64_of_numbers(displacements)}});
  }
  return list;
}

std::vector<Field> fields_of_frames(const Ingredients& ingredients) {
  std::vector<Field> fields = report_fields(ingredients);
  std::erase_if(fields, [](const Field& field) { return field.key != "u" && field.key != "r" && field.key != "eta"; });
  return fields;
}

}  // namespace

void SceneFrames::add(const computation::HistoryEntry& entry, const computation::Solution& solution,
                      std::int64_t most_points) {
  constexpr std::int64_t most_values = 1'500'000;  // 8 MB on the page
  if (seen_++ % every_ != 0) return;
  const assembly::DiscreteShell& discrete = *solution.discrete;
  SampledSurface surface = sampled_surface(solution, most_points, fields_of_frames(io::ingredients_of(discrete)));
  std::vector<obstacle::Placement> places;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) places.push_back(discrete.obstacles.now(k).placement);
  frames_.push_back({entry.factors.time, entry.step, std::move(surface.drawing), std::move(surface.fields),
                     std::move(surface.rows), std::move(places)});
  if (std::ssize(frames_) * surface.points * 7 < most_values) return;
  every_ *= 2;
  std::vector<Frame> kept;
  for (std::size_t i = 0; i < frames_.size(); i += 2) kept.push_back(std::move(frames_[i]));
  frames_ = std::move(kept);
}

Json SceneFrames::json(const computation::Solution& last, std::span<const std::size_t> drawn,
                       const Drawing& drawing) const {
  Json list = Json::array();
  const assembly::DiscreteShell& discrete = *last.discrete;
  for (const Frame& frame : frames_) {
    if (frame.rows.empty() || frame.time >= discrete.state.factors.time) continue;
    const auto rows = redrawn(frame.rows, frame.drawing, drawing);
    Json json{{"time", frame.time}, {"step", frame.step}, {"obstacles", Json::array()}};
    std::size_t row = 0;
    for (const Field& field : frame.fields)
      for (int c = 0; c < field.components; ++c) json[field.key].push_back(row_json(rows[row++]));
    for (const std::size_t k : drawn) {
      const obstacle::Placement end = discrete.obstacles.now(k).placement, &now = frame.obstacles.at(k);
      const Eigen::Matrix3d turn = now.rotation * end.rotation.transpose();
      const Eigen::Vector3d way = now.translation - turn * end.translation;
      json["obstacles"].push_back({{"rotation",
                                    {turn(0, 0), turn(0, 1), turn(0, 2), turn(1, 0), turn(1, 1), turn(1, 2), turn(2, 0),
                                     turn(2, 1), turn(2, 2)}},
                                   {"translation", {way[0], way[1], way[2]}}});
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json scene_json(const computation::Solution& solution, const solution::Summary& summary,
                const problem::UnitNames& units, const SceneFrames& frames, std::int64_t most_points) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const fem::Space& space = discrete.space();
  const SampledSurface surface =
      sampled_surface(solution, most_points, report_fields(io::ingredients_of(discrete)), solution.modes);
  const obstacle::Extent extent = io::surroundings(solution);
  const Json supports = supports_json(discrete, solution.nodal), loads = loads_json(solution);
  return algebra::in_agreement(space.layout->comm, [&] {
    if (algebra::rank_in(space.layout->comm) != 0 || surface.rows.empty()) return Json(nullptr);
    const auto obstacles = io::drawn_obstacles(discrete.obstacles, extent);
    std::vector<std::size_t> drawn;
    drawn.reserve(obstacles.size());
    for (const io::DrawnObstacle& obstacle : obstacles) drawn.push_back(obstacle.number);
    return Json{{"shape", space.shape() == mesh::Shape::triangle ? "triangle" : "quadrilateral"},
                {"subdivisions", surface.cells.subdivisions},
                {"cells", surface.cells.count},
                {"points", surface.points},
                {"mesh_cells", space.global_cells},
                {"degree", space.degree},
                {"merged", 1 << surface.cells.merged_levels},
                {"fields", fields_json(surface, units)},
                {"obstacles", obstacles_json(obstacles, summary)},
                {"time", discrete.state.factors.time},
                {"frames", frames.json(solution, drawn, surface.drawing)},
                {"lines", lines_json(summary)},
                {"touches_on_areas", touches_on_areas(summary)},
                {"supports", supports},
                {"loads", loads}};
  });
}

}  // namespace plastron::report
