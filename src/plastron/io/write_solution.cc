#include <plastron/io/solution_file.hpp>
#include <plastron/io/solution_record.hpp>

namespace plastron::io {

CellHead cell_head(const fem::Space& space, std::size_t cell) {
  const fem::Cell& c = space.cells[cell];
  CellHead head{.place = fem::place_of(c)};
  const fem::CellMap& map = space.coarse->cells[static_cast<std::size_t>(c.coarse)].map;
  std::size_t next = 0;
  for (const Eigen::Vector2d& xi : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)})
    for (const double x : map(c.corner + c.size * xi).value) head.at[next++] = x;
  return head;
}

std::vector<double> flat_cuts(const std::vector<fem::Cuts>& cuts) {
  std::vector<double> list;
  for (const fem::Cuts& of_cell : cuts)
    for (const std::vector<double>& points : of_cell) {
      list.push_back(static_cast<double>(points.size()));
      list.insert(list.end(), points.begin(), points.end());
    }
  return list;
}

namespace {

void append_bytes(std::string& text, const void* data, std::size_t bytes) {
  text.append(static_cast<const char*>(data), bytes);
}

SolutionHeader header_of(const computation::Solution& solution) {
  const fem::Space& space = solution.discrete->space();
  const assembly::State& state = solution.discrete->state;
  return {.corners = static_cast<std::uint32_t>(fem::corner_count(space.shape())),
          .degree = static_cast<std::uint32_t>(space.degree),
          .obstacles = static_cast<std::uint32_t>(solution.discrete->obstacles.all.size()),
          .has_multiplier = solution.nodal.lambda.layout() ? 1u : 0u,
          .is_deformed = static_cast<std::uint16_t>(state.is_deformed()),
          .has_lifts = static_cast<std::uint16_t>(state.is_admissible()),
          .cells = space.global_cells,
          .nodes = space.layout->global_size,
          .time = state.time,
          .load_factor = state.load_factor,
          .cut_numbers = static_cast<std::int64_t>(flat_cuts(space.coarse->cuts).size())};
}

/// The vectors of a node's values, in the order of the file. Ghosts have exactly their owners' values: a node has
/// the same value on any rank that writes it (collective).
struct NodeFields {
  explicit NodeFields(const computation::Solution& solution) {
    const solution::NodalSolution& nodal = solution.nodal;
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
  int rank = 0;
  MPI_Comm_rank(files.comm(), &rank);
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
    }
    for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
      const CellHead head = cell_head(space, cell);
      append_bytes(text, &head, sizeof head);
      for (const algebra::LocalIndex node : space.nodes(cell)) fields.append(static_cast<std::size_t>(node), text);
    }
    return text;
  });
}

}  // namespace plastron::io
