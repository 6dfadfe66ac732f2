#include <plastron/algebra/agreement.hpp>
#include <plastron/io/binary_file.hpp>
#include <plastron/io/solution_file.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plastron::io {

CellHead cell_head(const fem::Space& space, std::size_t cell) {
  const fem::Cell& c = space.cells[cell];
  CellHead head{.place = fem::place_of(c)};
  const mesh::CellMap& map = space.coarse->cells[static_cast<std::size_t>(c.coarse)].map;
  std::size_t next = 0;
  for (const Eigen::Vector2d& xi : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)})
    for (const double x : map(c.corner + c.size * xi).value) head.at[next++] = x;
  return head;
}

std::vector<double> flat_cuts(const std::vector<mesh::Cuts>& cuts) {
  std::vector<double> list;
  for (const mesh::Cuts& of_cell : cuts)
    for (const std::vector<double>& points : of_cell) {
      list.push_back(static_cast<double>(points.size()));
      list.insert(list.end(), points.begin(), points.end());
    }
  return list;
}

namespace {

SolutionHeader header_of(const computation::Solution& solution) {
  const fem::Space& space = solution.discrete->space();
  const assembly::State& state = solution.discrete->state;
  return {
      .corners = static_cast<std::uint32_t>(mesh::corner_count(space.shape())),
      .degree = static_cast<std::uint32_t>(space.degree),
      .obstacles = static_cast<std::uint32_t>(solution.discrete->obstacles.all.size()),
      .has_multiplier = solution.nodal.lambda.layout() ? 1u : 0u,
      .is_deformed = static_cast<std::uint16_t>(state.is_deformed()),
      .has_lifts = static_cast<std::uint16_t>(state.is_admissible()),
      .cells = space.global_cells,
      .nodes = space.layout->global_size,
      .time = state.factors.time,
      .loads = state.control ? energy::Factors(state.factors).controlled(state.control->factor) : state.factors.loads,
      .supports = state.factors.supports,
      .cut_numbers = static_cast<std::int64_t>(flat_cuts(space.coarse->cuts).size()),
      .path_states = static_cast<std::int64_t>(solution.path.size())};
}

/// Returns the first values of each node, or these and zeros.
algebra::Vector with_block(const algebra::Vector& field, int block) {
  algebra::Vector result(field.layout(), block);
  const auto from = static_cast<std::size_t>(field.block()), to = static_cast<std::size_t>(block);
  for (std::size_t i = 0; i * to < result.local().size(); ++i)
    std::copy_n(field.local().data() + i * from, std::min(from, to), result.local().data() + i * to);
  return result;
}

/// The numbers of the path before the cells.
std::vector<double> flat_path(const computation::Solution& solution) {
  std::vector<double> list;
  for (const certificate::Station& station : solution.path) {
    list.push_back(station.time);
    list.insert(list.end(), station.positions.begin(), station.positions.end());
  }
  return list;
}

/// The vectors of a node's values, in the order of the file. Ghosts have exactly their owners' values: a node has
/// the same value on any rank that writes it (collective).
struct NodeFields {
  explicit NodeFields(const computation::Solution& solution) {
    const solution::NodalSolution& nodal = solution.nodal;
    for (const certificate::Station& station : solution.path) add(with_block(station.displacement, 3));
    add(nodal.y);
    if (solution.discrete->state.is_deformed()) add(solution.discrete->state.displacement);
    if (nodal.lambda.layout()) add(nodal.lambda);
    if (solution.discrete->obstacles.empty()) return;
    add(nodal.pressure);
    add(nodal.touching);
    if (solution.discrete->state.is_admissible()) add(solution.discrete->state.lifts);
  }
  void append(std::size_t node, std::string& text) const {
    for (const algebra::Vector& field : fields) {
      const auto block = static_cast<std::size_t>(field.block());
      append_bytes(text, field.local().data() + node * block, block * sizeof(double));
    }
  }

 private:
  void add(const algebra::Vector& field) { fields.emplace_back(field).update_ghosts(); }
  std::vector<algebra::Vector> fields{};
};

}  // namespace

void add_solution(const computation::Solution& solution, const std::filesystem::path& path, AtomicFiles& files) {
  const fem::Space& space = solution.discrete->space();
  const SolutionHeader header = header_of(solution);
  const NodeFields fields(solution);
  const int rank = algebra::rank_in(files.comm());
  files.add(path, [&] {
    std::string text;
    text.reserve(preamble_size(header) + space.owned_cells * record_size(header, space.nodes_per_cell()));
    if (rank == 0) {
      append_bytes(text, &header, sizeof header);
      for (std::size_t k = 0; k < solution.discrete->obstacles.all.size(); ++k) {
        const ObstacleRecord record{solution.discrete->state.position(k), solution.discrete->way_pressed(k)};
        append_bytes(text, &record, sizeof record);
      }
      const std::vector<double> cuts = flat_cuts(space.coarse->cuts);
      append_bytes(text, cuts.data(), cuts.size() * sizeof(double));
      const std::vector<double> states = flat_path(solution);
      append_bytes(text, states.data(), states.size() * sizeof(double));
    }
    for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
      const CellHead head = cell_head(space, cell);
      append_bytes(text, &head, sizeof head);
      for (const algebra::LocalIndex node : space.nodes(cell)) fields.append(static_cast<std::size_t>(node), text);
    }
    return text;
  });
}

std::optional<std::vector<mesh::Cuts>> cuts_of_list(std::span<const double> list) {
  constexpr double least_part = 1e-9;  // part of a side
  std::vector<mesh::Cuts> cuts;
  const auto take = [&](std::vector<double>& points) {
    if (list.empty() || !(list[0] >= 0) || !(list[0] < static_cast<double>(list.size()))) return false;
    if (list[0] != std::floor(list[0])) return false;
    const auto count = static_cast<std::size_t>(list[0]);
    const auto of_cell = list.subspan(1, count);
    points.assign(of_cell.begin(), of_cell.end());
    list = list.subspan(1 + count);
    double last = 0;
    for (const double x : points)
      if (!(x - std::exchange(last, x) >= least_part)) return false;
    return 1 - last >= least_part;
  };
  while (!list.empty())
    for (std::vector<double>& points : cuts.emplace_back())
      if (!take(points)) return std::nullopt;
  return cuts;
}

namespace {

/// The part of the file before its cells.
class SolutionFile : public BinaryFile {
 public:
  explicit SolutionFile(const std::filesystem::path& path) : BinaryFile(path) {
    if (size() < sizeof header_) refuse("the file is too short to hold a solution");
    read(&header_, sizeof header_);
    check_format();
  }

  /// Call it before cells are read, and after the rest of the header was found correct: that gives a better
  /// explanation.
  void check_size() const {
    constexpr std::int64_t most_cells = std::int64_t{1} << 40;  // prevents overflow of sizes
    const auto cells = static_cast<std::uintmax_t>(std::min(header_.cells, most_cells));
    require_size(preamble_size(header_) + cells * record_size(header_, nodes_per_cell()));
  }

  const SolutionHeader& header() const { return header_; }
  int nodes_per_cell() const {
    const auto shape = header_.corners == 3 ? mesh::Shape::triangle : mesh::Shape::quadrilateral;
    return mesh::nodes_per_cell(shape, static_cast<int>(header_.degree));
  }

 private:
  void check_format() const {
    constexpr std::uint32_t most_obstacles = 10000;
    constexpr std::int64_t most_cut_numbers = 1 << 24, most_path_states = 1 << 16;
    const SolutionHeader ours;
    if (header_.magic != ours.magic) refuse("the file is not a solution of Plastron: it begins differently");
    if (header_.version != ours.version)
      refuse(fmt::format("the file has version {} of the format; this program reads version {}", header_.version,
                         ours.version));
    const bool is_sound = (header_.corners == 3 || header_.corners == 4) && header_.degree >= 1 &&
                          header_.degree <= 8 && header_.obstacles <= most_obstacles && header_.has_multiplier <= 1 &&
                          header_.has_lifts <= 1 && header_.is_deformed <= 1 && header_.cells >= 0 &&
                          header_.cut_numbers >= 0 && header_.cut_numbers <= most_cut_numbers &&
                          header_.path_states >= 0 && header_.path_states <= most_path_states &&
                          std::isfinite(header_.time) && std::isfinite(header_.loads) &&
                          std::isfinite(header_.supports);
    if (!is_sound) refuse("the header contains impossible values");
  }

  SolutionHeader header_{};
};

/// No solution has a larger number, and the fourth power of this one is finite.
constexpr double largest_value = 1e60;

class SolutionReader {
 public:
  SolutionReader(std::filesystem::path path, const fem::Space& space, const SolutionShape& shape)
      : file_(path), header_(file_.header()), space_(space), shape_(shape) {
    check_problem();
    file_.check_size();
    obstacles_.resize(header_.obstacles);
    for (ObstacleRecord& record : obstacles_) {
      file_.read(&record, sizeof record);
      if (!(std::abs(record[0]) <= largest_value && std::abs(record[1]) <= largest_value))
        refuse(fmt::format("the position of an obstacle is not finite, or beyond {:g}", largest_value));
    }
    file_.skip(static_cast<std::size_t>(header_.cut_numbers) * sizeof(double));
    path_.resize(header_.path_numbers());
    file_.read(path_.data(), path_.size() * sizeof(double));
    for (const double number : path_)
      if (!(std::abs(number) <= largest_value))
        refuse(fmt::format("a time or a position on the path is not finite, or beyond {:g}", largest_value));
  }

  const SolutionHeader& header() const { return header_; }
  const std::vector<ObstacleRecord>& obstacles() const { return obstacles_; }
  /// Times and positions of the states on the path.
  std::vector<certificate::Station> path() const {
    std::vector<certificate::Station> stations;
    for (std::size_t at = 0; at < path_.size(); at += 1 + header_.obstacles)
      stations.push_back({.time = path_[at],
                          .positions = {path_.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                                        path_.begin() + static_cast<std::ptrdiff_t>(at + 1 + header_.obstacles)}});
    return stations;
  }

  /// Calls take(node, values) for each node of each cell that this rank owns.
  template <class Take>
  void for_nodes(const Take& take) {
    std::map<fem::CellPlace, std::size_t> mine;
    for (std::size_t cell = 0; cell < space_.owned_cells; ++cell) mine.emplace(cell_head(space_, cell).place, cell);
    const std::size_t per_node = header_.values_per_node();
    std::vector<double> values(static_cast<std::size_t>(space_.nodes_per_cell()) * per_node);
    for (std::int64_t record = 0; record < header_.cells; ++record) {
      CellHead head;
      file_.read(&head, sizeof head);
      file_.read(values.data(), values.size() * sizeof(double));
      const auto found = mine.find(head.place);
      if (found == mine.end()) continue;
      check_record(head, found->second, values);
      const auto nodes = space_.nodes(found->second);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        take(static_cast<std::size_t>(nodes[i]), std::span(values).subspan(i * per_node, per_node));
      mine.erase(found);
    }
    if (!mine.empty()) refuse("cells of the case's finest mesh are missing in the file, or occur twice");
  }

  [[noreturn]] void refuse(const std::string& what) const { file_.refuse(what); }

 private:
  /// Checks that the file belongs to the mesh and the problem.
  void check_problem() const {
    const auto same = [this](const char* what, std::int64_t found, std::int64_t wanted) {
      if (found != wanted) refuse(fmt::format("the file has {} {}, the case requires {}", found, what, wanted));
    };
    same("corners per cell", header_.corners, mesh::corner_count(space_.shape()));
    same("as the degree", header_.degree, space_.degree);
    same("obstacles", header_.obstacles, shape_.obstacles);
    same("multipliers per node", header_.has_multiplier, shape_.has_multiplier ? 1 : 0);
    same("lifts per gap", header_.has_lifts, shape_.has_lifts ? 1 : 0);
    same("numbers of cuts", header_.cut_numbers, static_cast<std::int64_t>(flat_cuts(space_.coarse->cuts).size()));
    same("cells", header_.cells, space_.global_cells);
    same("nodes", header_.nodes, space_.layout->global_size);
  }
  void check_record(const CellHead& head, std::size_t cell, const std::vector<double>& values) const {
    const CellHead ours = cell_head(space_, cell);
    const double tolerance = mesh::point_tolerance(*space_.coarse);
    for (std::size_t k = 0; k < ours.at.size(); ++k)
      if (!(std::abs(head.at[k] - ours.at[k]) <= tolerance))
        refuse(
            fmt::format("a cell lies at ({:g}, {:g}), on the case's mesh at ({:g}, {:g}): the mesh is different, "
                        "or made by another version of the mesh generator",
                        head.at[0], head.at[1], ours.at[0], ours.at[1]));
    for (const double value : values)
      if (!(std::abs(value) <= largest_value))
        refuse(fmt::format("a value in the cell at ({:g}, {:g}) is not finite, or beyond {:g}", ours.at[0], ours.at[1],
                           largest_value));
    const std::size_t per_node = header_.values_per_node(), end = per_node - header_.has_lifts * header_.obstacles;
    for (std::size_t node = 0; node < values.size(); node += per_node)
      for (std::size_t k = node + end - header_.obstacles; k < node + end; ++k)
        if (values[k] != 0 && values[k] != 1)
          refuse(fmt::format("a node of the cell at ({:g}, {:g}) has the contact state {:g}; it can be 0 or 1",
                             ours.at[0], ours.at[1], values[k]));
  }

  SolutionFile file_;
  SolutionHeader header_;
  const fem::Space& space_;
  const SolutionShape& shape_;
  std::vector<ObstacleRecord> obstacles_{};
  std::vector<double> path_{};
};

/// Returns the vectors of a node's values, in the order of the file.
std::vector<algebra::Vector*> fields_of_file(const SolutionHeader& header, computation::StoredSolution& solution,
                                             const std::shared_ptr<const algebra::Layout>& layout) {
  std::vector<algebra::Vector*> fields;
  const auto add = [&](algebra::Vector& field, int block, bool is_stored) {
    field = algebra::Vector(layout, block);
    if (is_stored) fields.push_back(&field);
  };
  solution::NodalSolution& nodal = solution.nodal;
  const int obstacles = static_cast<int>(header.obstacles);
  for (certificate::Station& station : solution.path) add(station.displacement, 3, true);
  add(nodal.y, 6, true);
  if (header.is_deformed) add(solution.state.displacement, 6, true);
  if (header.has_multiplier) add(nodal.lambda, 1, true);
  add(nodal.pressure, std::max(1, obstacles), obstacles > 0);
  add(nodal.touching, std::max(1, obstacles), obstacles > 0);
  if (header.has_lifts) add(solution.state.lifts, obstacles, true);
  return fields;
}

constexpr const char* torn = "the values at a node differ from cell to cell: the file is damaged or was edited";

/// Checks that every ghost in a cell of this rank has its owner's value (collective).
void check_ghosts(algebra::Vector& field, const std::vector<char>& is_read, const SolutionReader& reader) {
  const std::vector<double> before(field.local().begin(), field.local().end());
  field.update_ghosts();
  algebra::in_agreement<UnusableResults>(field.layout()->comm, [&] {
    const auto block = static_cast<std::size_t>(field.block());
    for (std::size_t k = 0; k < before.size(); ++k)
      if (is_read[k / block] && field.local()[k] != before[k]) reader.refuse(torn);
  });
}

/// Returns the number of coarse cells after the cuts.
std::int64_t cells_of(const std::vector<mesh::Cuts>& cuts) {
  std::int64_t cells = 0;
  for (const auto& [across_first, across_second] : cuts)
    cells += static_cast<std::int64_t>(across_first.size() + 1) * static_cast<std::int64_t>(across_second.size() + 1);
  return cells;
}

}  // namespace

computation::MeshCells stored_cells(const std::filesystem::path& path, MPI_Comm comm) {
  return algebra::in_agreement<UnusableResults>(comm, [&] {
    SolutionFile file(path);
    file.check_size();
    const std::size_t record = record_size(file.header(), file.nodes_per_cell());
    file.skip(file.header().obstacles * sizeof(ObstacleRecord));
    std::vector<double> list(static_cast<std::size_t>(file.header().cut_numbers));
    file.read(list.data(), list.size() * sizeof(double));
    file.skip(file.header().path_numbers() * sizeof(double));
    auto cuts = cuts_of_list(list);
    if (!cuts || cells_of(*cuts) > file.header().cells) file.refuse("its list of cuts of coarse cells is invalid");
    computation::MeshCells cells{.cuts = std::move(*cuts)};
    cells.places.resize(static_cast<std::size_t>(file.header().cells));
    for (fem::CellPlace& place : cells.places) {
      CellHead head;
      file.read(&head, sizeof head);
      file.skip(record - sizeof head);
      place = head.place;
    }
    return cells;
  });
}

computation::StoredSolution read_solution(const std::filesystem::path& path,
                                          const std::shared_ptr<const fem::Space>& space, const SolutionShape& shape) {
  const auto& layout = space->layout;
  const auto reader = algebra::in_agreement<UnusableResults>(
      layout->comm, [&] { return std::make_unique<SolutionReader>(path, *space, shape); });
  computation::StoredSolution solution;
  const SolutionHeader& header = reader->header();
  solution.state.factors = {.time = header.time, .loads = header.loads, .supports = header.supports};
  for (const auto& [position, way] : reader->obstacles()) {
    solution.state.positions.push_back(position);
    solution.ways.push_back(way);
  }
  solution.path = reader->path();
  const auto fields = fields_of_file(reader->header(), solution, layout);
  std::vector<char> is_read(static_cast<std::size_t>(layout->local_size()), 0);
  algebra::in_agreement<UnusableResults>(layout->comm, [&] {
    reader->for_nodes([&](std::size_t node, std::span<const double> values) {
      std::size_t next = 0;
      for (algebra::Vector* field : fields) {
        const auto block = static_cast<std::size_t>(field->block());
        for (double& value : field->local().subspan(node * block, block)) {
          if (is_read[node] && value != values[next]) reader->refuse(torn);
          value = values[next++];
        }
      }
      is_read[node] = 1;
    });
  });
  for (algebra::Vector* field : fields) check_ghosts(*field, is_read, *reader);
  for (certificate::Station& station : solution.path) station.displacement = with_block(station.displacement, 6);
  return solution;
}

}  // namespace plastron::io
