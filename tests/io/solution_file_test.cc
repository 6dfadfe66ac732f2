// solution.plastron: every digit comes back on any number of ranks, and damaged files are refused.
#include <plastron/io/solution_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

namespace plastron::io {

namespace {

using computation::Solution;
using computation::StoredSolution;
using problem::Problem;
using testing::HasSubstr;

constexpr std::size_t header_bytes = 88 + 16, head_bytes = 64;  // one obstacle

SolutionShape shape_of(const Problem& problem) {
  return {.obstacles = static_cast<int>(problem.shell.obstacles.all.size()),
          .has_multiplier = problem.shell.tangency.formulation == element::Formulation::mixed,
          .has_lifts = problem.admissible};
}

StoredSolution read(const std::filesystem::path& path, const Problem& problem, MPI_Comm comm) {
  return read_solution(path, computation::finest_mesh(problem, comm).space, shape_of(problem));
}

void write(const Solution& solution, const std::filesystem::path& path, MPI_Comm comm) {
  AtomicFiles files(comm);
  add_solution(solution, path, files);
  files.commit();
}

/// A plate over a plane, or over a ball, for which its gaps are linearised again.
Problem plate(element::Formulation formulation, mesh::Shape shape, bool over_ball = false) {
  Problem p = pressed_plate({.shape = shape});
  p.shell.tangency.formulation = formulation;
  if (over_ball)
    p.shell.obstacles.all = {obstacle::Obstacle{.shape = obstacle::Ball{.centre = {1, 0.5, -5}, .radius = 5}}};
  return p;
}

std::vector<Problem> problems() {
  using element::Formulation;
  std::vector<Problem> all;
  for (const Formulation f : {Formulation::tangent, Formulation::penalised, Formulation::mixed, Formulation::classical})
    all.push_back(plate(f, mesh::Shape::quadrilateral));
  all.push_back(plate(Formulation::tangent, mesh::Shape::triangle));
  all.push_back(plate(Formulation::tangent, mesh::Shape::quadrilateral, true));
  all.push_back(all.back());
  all.back().admissible = true;
  all.push_back(pressed_plate({.obstacle = false}));
  return all;
}

void expect_equal(const algebra::Vector& a, const algebra::Vector& b) {
  ASSERT_EQ(a.owned().size(), b.owned().size());
  EXPECT_TRUE(std::equal(a.owned().begin(), a.owned().end(), b.owned().begin()));
}

TEST(SolutionFile, GivesEveryDigitBack) {
  const ScratchDirectory scratch("digits");
  bool some_deformed = false, some_multiplier = false, some_lifts = false;
  for (const Problem& problem : problems()) {
    const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
    const Solution& solution = *result.solution;
    write(solution, scratch.path / "solution.plastron", MPI_COMM_WORLD);
    const StoredSolution stored = read(scratch.path / "solution.plastron", problem, MPI_COMM_WORLD);
    expect_equal(stored.nodal.y, solution.nodal.y);
    expect_equal(stored.nodal.pressure, solution.nodal.pressure);
    expect_equal(stored.nodal.touching, solution.nodal.touching);
    ASSERT_EQ(stored.nodal.lambda.layout() == nullptr, solution.nodal.lambda.layout() == nullptr);
    if (solution.nodal.lambda.layout()) expect_equal(stored.nodal.lambda, solution.nodal.lambda);
    const assembly::State& state = solution.discrete->state;
    ASSERT_EQ(stored.state.is_deformed(), state.is_deformed());
    if (state.is_deformed()) expect_equal(stored.state.displacement, state.displacement);
    ASSERT_EQ(stored.state.is_admissible(), state.is_admissible());
    if (state.is_admissible()) expect_equal(stored.state.lifts, state.lifts);
    some_lifts = some_lifts || (state.is_admissible() && algebra::max_abs(state.lifts) > 0);
    EXPECT_EQ(stored.state.factors.time, state.factors.time);
    EXPECT_EQ(stored.state.factors.loads, state.factors.loads);
    some_deformed = some_deformed || state.is_deformed();
    some_multiplier = some_multiplier || solution.nodal.lambda.layout() != nullptr;
  }
  EXPECT_TRUE(some_deformed && some_multiplier && some_lifts);
}

/// The records of a file in sorted order.
std::vector<std::string> sorted_records(const std::string& text, std::size_t cells) {
  const std::size_t size = (text.size() - header_bytes) / cells;
  std::vector<std::string> records;
  for (std::size_t c = 0; c < cells; ++c) records.push_back(text.substr(header_bytes + c * size, size));
  std::ranges::sort(records);
  return records;
}

TEST(SolutionFile, IsTheSameWhateverRanksWriteItAndReadIt) {
  const ScratchDirectory scratch("ranks");
  const auto one = scratch.path / "one.plastron", many = scratch.path / "many.plastron";
  for (const Problem& problem : problems()) {
    const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
    write(*result.solution, many, MPI_COMM_WORLD);
    // One rank alone reads the file of all and writes it again: only the order of cells may differ.
    if (world_rank() == 0) {
      const computation::FinestMesh mesh = computation::finest_mesh(problem, MPI_COMM_SELF);
      auto alone = computation::verify(problem, mesh, read_solution(many, mesh.space, shape_of(problem)));
      EXPECT_EQ(alone.result.status, contact::Status::solved);
      EXPECT_NEAR(alone.result.summary.energy.total() / result.summary.energy.total(), 1, 1e-12);
      write(*alone.result.solution, one, MPI_COMM_SELF);
      const auto cells = static_cast<std::size_t>(mesh.space->global_cells);
      EXPECT_EQ(text_of(one).substr(0, header_bytes), text_of(many).substr(0, header_bytes));
      EXPECT_EQ(sorted_records(text_of(one), cells), sorted_records(text_of(many), cells));
    }
    MPI_Barrier(MPI_COMM_WORLD);
    // All ranks read the file of one and have the same values.
    const StoredSolution stored = read(one, problem, MPI_COMM_WORLD);
    expect_equal(stored.nodal.y, result.solution->nodal.y);
    expect_equal(stored.nodal.pressure, result.solution->nodal.pressure);
    MPI_Barrier(MPI_COMM_WORLD);
  }
}

/// Inserts the bytes of a number into the text.
template <class Number>
void put(std::string& text, std::size_t at, Number number) {
  std::memcpy(text.data() + at, &number, sizeof number);
}

TEST(SolutionFile, ThatIsDamagedIsRefusedInWords) {
  const ScratchDirectory scratch("damaged");
  const auto path = scratch.path / "solution.plastron";
  const Problem problem = plate(element::Formulation::tangent, mesh::Shape::quadrilateral);
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  write(*result.solution, path, MPI_COMM_WORLD);
  const std::string good = text_of(path);
  const std::size_t per_node = 8 * sizeof(double), first_node = header_bytes + head_bytes;  // u, r, eta, touching
  const std::size_t record = head_bytes + 9 * per_node;
  const std::vector<std::pair<const char*, std::function<void(std::string&)>>> damages{
      {"too short", [](std::string& t) { t.resize(30); }},
      {"too short", [](std::string& t) { t.clear(); }},
      {"incomplete", [](std::string& t) { t.pop_back(); }},
      {"incomplete", [](std::string& t) { t += '\0'; }},
      {"begins differently", [](std::string& t) { t[0] = 'p'; }},
      {"version 1", [](std::string& t) { put(t, 8, std::uint32_t{1}); }},
      {"version 5", [](std::string& t) { put(t, 8, std::uint32_t{5}); }},
      {"corners per cell", [](std::string& t) { put(t, 12, std::uint32_t{3}); }},
      {"degree", [](std::string& t) { put(t, 16, std::uint32_t{4}); }},
      {"2 obstacles", [](std::string& t) { put(t, 20, std::uint32_t{2}); }},
      {"multipliers", [](std::string& t) { put(t, 24, std::uint32_t{1}); }},
      {"incomplete", [](std::string& t) { put(t, 28, std::uint32_t{1}); }},
      {"impossible values", [](std::string& t) { put(t, 28, std::uint32_t{1000}); }},
      {"lifts per gap", [](std::string& t) { put(t, 30, std::uint16_t{1}); }},
      {"cells", [](std::string& t) { put(t, 32, std::int64_t{1} << 60); }},
      {"nodes", [](std::string& t) { put(t, 40, std::int64_t{-1}); }},
      {"impossible values", [](std::string& t) { put(t, 56, std::numeric_limits<double>::quiet_NaN()); }},
      {"impossible values", [](std::string& t) { put(t, 64, std::numeric_limits<double>::infinity()); }},
      {"3 numbers of cuts", [](std::string& t) { put(t, 72, std::int64_t{3}); }},
      {"impossible values", [](std::string& t) { put(t, 72, std::int64_t{-1}); }},
      {"impossible values", [](std::string& t) { put(t, 72, std::int64_t{1} << 60); }},
      {"missing in the file",
       [&](std::string& t) { t.replace(header_bytes, record, t.substr(header_bytes + record, record)); }},
      {"missing in the file", [](std::string& t) { put(t, header_bytes, std::int32_t{1000}); }},
      {"the mesh is different", [](std::string& t) { put(t, header_bytes + 16, 0.123); }},
      {"not finite", [&](std::string& t) { put(t, first_node, std::numeric_limits<double>::infinity()); }},
      {"not finite", [&](std::string& t) { put(t, first_node + 40, std::numeric_limits<double>::quiet_NaN()); }},
  };
  for (const auto& [words, damage] : damages) {
    std::string text = good;
    damage(text);
    if (world_rank() == 0) std::ofstream(path, std::ios::binary) << text;
    MPI_Barrier(MPI_COMM_WORLD);
    try {
      read(path, problem, MPI_COMM_WORLD);
      ADD_FAILURE() << "was taken: " << words;
    } catch (const UnusableResults& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
      EXPECT_THAT(error.what(), HasSubstr("solution.plastron"));
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  EXPECT_THROW(read(scratch.path / "none.plastron", problem, MPI_COMM_WORLD), UnusableResults);
  EXPECT_THROW(read(scratch.path, problem, MPI_COMM_WORLD), UnusableResults);
}

TEST(SolutionFile, KeepsCutsOfTheCoarseMesh) {
  const std::vector<mesh::Cuts> cuts{{std::vector{0.25, 0.5}, {}}, {}, {std::vector{0.1}, std::vector{0.2, 0.7, 0.9}}};
  const std::vector<double> list = flat_cuts(cuts);
  EXPECT_EQ(list.size(), 12U);
  EXPECT_EQ(cuts_of_list(list), cuts);
  EXPECT_EQ(cuts_of_list({}), std::vector<mesh::Cuts>());
  using List = std::vector<double>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const List& wrong :
       {List{1, 0.5}, List{2, 0.5, 0}, List{1, 0, 0}, List{2, 0.5, 0.4, 0}, List{1, 1.5, 0}, List{-1, 0}, List{0.5, 0},
        List{1.5, 0.3, 0}, List{1, 1e-300, 0}, List{1e300, 0}, List{nan, 0}, List{1, nan, 0}})
    EXPECT_FALSE(cuts_of_list(wrong)) << wrong.front();
}

/// A megabyte that would make billions of cells.
TEST(SolutionFile, WithCutsForMoreCellsThanItHasIsRefused) {
  constexpr int each_way = 65534;
  std::vector<double> points;
  for (int i = 1; i <= each_way; ++i) points.push_back(i / (each_way + 1.0));
  const std::vector<double> list = flat_cuts({{points, points}});
  const SolutionHeader header{.cut_numbers = static_cast<std::int64_t>(list.size())};
  std::string bytes(sizeof header + list.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, list.data(), list.size() * sizeof(double));
  const ScratchDirectory scratch("cuts");
  std::ofstream(scratch.path / "a.plastron", std::ios::binary) << bytes;
  EXPECT_THROW(stored_cells(scratch.path / "a.plastron", MPI_COMM_SELF), UnusableResults);
}

TEST(SolutionFile, WithTwoValuesAtANodeIsRefused) {
  const ScratchDirectory scratch("torn");
  const auto path = scratch.path / "solution.plastron";
  const Problem problem = plate(element::Formulation::tangent, mesh::Shape::quadrilateral);
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  write(*result.solution, path, MPI_COMM_WORLD);
  const std::string good = text_of(path);
  const std::size_t record = head_bytes + 9 * 64;
  // One corner of every cell in turn. At some corners inside the shell other cells meet, whichever ranks they
  // belong to.
  int refused = 0;
  for (std::size_t cell = 0; cell < 16; ++cell) {
    std::string text = good;
    double value = 0;
    const std::size_t at = header_bytes + cell * record + head_bytes + 16;
    std::memcpy(&value, text.data() + at, sizeof value);
    put(text, at, value + 1e-9);
    if (world_rank() == 0) std::ofstream(path, std::ios::binary) << text;
    MPI_Barrier(MPI_COMM_WORLD);
    try {
      read(path, problem, MPI_COMM_WORLD);
    } catch (const UnusableResults& error) {
      EXPECT_THAT(error.what(), HasSubstr("differ from cell to cell"));
      ++refused;
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  EXPECT_EQ(refused, 15);  // the corner of the shell has one cell
}

}  // namespace

}  // namespace plastron::io
