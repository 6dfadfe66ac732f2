// Modes in files, and shells that have their shapes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/io/mode_file.hpp>
#include <plastron/io/results.hpp>
#include <plastron/report/report_scene.hpp>
#include <plastron/workflow/output.hpp>

#include <cmath>
#include <computation/problems.hpp>
#include <fstream>
#include <functional>
#include <io/scratch_directory.hpp>
#include <numbers>

namespace plastron::io {
namespace {

using test::Direction;
using test::Expression;
using test::held;
using testing::HasSubstr;
using workflow::Output;

constexpr double thickness = 0.01;

/// A strip between hinges under half of Euler's load.
problem::Problem pushed_strip() {
  problem::Problem p = test::free_plate();
  p.domain = domain::Rectangle{.to = {1, 0.1}, .cells = {4, 1}};
  p.shell.sections.common.thickness = Expression(thickness);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0, 1);
  p.shell.supports = {held("left", {Direction::x, Direction::z}), held("right", {Direction::z}),
                      test::in_plane("bottom"), test::in_plane("top")};
  const double force = std::numbers::pi * std::numbers::pi * std::pow(thickness, 3) / 24;
  p.shell.loads.on_edges = {{.boundary = "right", .force = test::vector(-force, 0, 0)}};
  p.probes = {{.name = "middle", .at = {0.5, 0.05}}};
  p.discretisation = {.degree = 4, .refinements = 1};
  p.checks_model = false;
  return p;
}

struct FoundMode {
  double factor;
  std::filesystem::path file;
};

FoundMode first_mode(const ScratchDirectory& scratch) {
  problem::Problem p = pushed_strip();
  p.modes.buckling = 2;
  const computation::Result r = computation::solve(p, MPI_COMM_WORLD);
  AtomicFiles files(MPI_COMM_WORLD);
  EXPECT_EQ(add_modes(*r.solution, scratch.path, files),
            (std::vector<std::string>{"buckling_1.mode", "buckling_2.mode"}));
  files.commit();
  return {.factor = r.modes.at(0).value, .file = scratch.path / "buckling_1.mode"};
}

// With the shape of its first mode, a column's deflection is the imperfection divided by (load factor - 1), as long as it is
// small: the mode solves the equations of the increment.
TEST(Mode, AsAnImperfectionIsAmplifiedAsTheBucklingLoadSays) {
  const ScratchDirectory scratch("modes");
  const FoundMode mode = first_mode(scratch);
  constexpr double amplitude = 1e-4 * thickness;
  for (const int degree : {4, 3}) {
    problem::Problem p = pushed_strip();
    p.shell.rotations = element::Rotations::finite;
    p.discretisation.degree = degree;
    p.imperfections = {{.amplitude = amplitude, .shift = read_mode(mode.file, amplitude, 0)}};
    const computation::Result r = computation::solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved);
    EXPECT_NEAR(std::abs(r.probes.at(0).values.u[2]) / amplitude * (mode.factor - 1), 1, 5e-4) << degree;
  }
}

/// Returns the reason why a shell cannot have the shape of the mode.
float absolute(float value) { return std::abs(value); }

std::string refusal_of(problem::Problem p, const FoundMode& mode) {
  p.imperfections = {{.amplitude = 1e-4, .shift = read_mode(mode.file, 1e-4, 0)}};
  try {
    static_cast<void>(computation::solve(p, MPI_COMM_WORLD));
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Mode, OfAnEarlierRunIsRemoved) {
  const ScratchDirectory scratch("earlier-modes");
  std::ofstream(scratch.path / "buckling_kept.mode") << "a user's own";
  first_mode(scratch);
  problem::Problem p = pushed_strip();
  p.modes.buckling = 1;
  Output(scratch.path, "solution", MPI_COMM_WORLD, false).finish(computation::solve(p, MPI_COMM_WORLD), {});
  EXPECT_TRUE(std::filesystem::exists(scratch.path / "buckling_1.mode"));
  EXPECT_FALSE(std::filesystem::exists(scratch.path / "buckling_2.mode"));
  EXPECT_TRUE(std::filesystem::exists(scratch.path / "buckling_kept.mode"));
}

TEST(Mode, IsInTheViewOfTheReport) {
  problem::Problem p = pushed_strip();
  p.modes.buckling = 2;
  const computation::Result result = computation::solve(p, MPI_COMM_WORLD);
  const computation::Solution& solution = *result.solution;
  const Json scene = report::scene_json(solution, result.summary);
  const auto surface = report::sampled_surface(solution, report::most_report_points, {}, solution.modes);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  ASSERT_EQ(scene.is_null(), rank != 0);
  if (rank != 0) return;
  std::vector<std::string> names;
  for (const Json& field : scene["fields"])
    if (field.contains("is_mode")) names.push_back(field["key"]);
  EXPECT_EQ(names, (std::vector<std::string>{"buckling_1", "buckling_2"}));
  ASSERT_EQ(surface.rows.size(), 6U);
  for (const std::size_t first : {0U, 3U}) {
    const auto largest = [&](std::size_t k) { return std::ranges::max(surface.rows[first + k], {}, absolute); };
    EXPECT_NEAR(absolute(largest(2)), 1, 0.02) << first;  // the strip bends out of its plane
    EXPECT_LT(absolute(largest(0)), 0.1) << first;
  }
}

TEST(Mode, BelongsToOneShell) {
  const ScratchDirectory scratch("other-shells");
  const FoundMode mode = first_mode(scratch);
  problem::Problem p = pushed_strip();
  EXPECT_EQ(refusal_of(p, mode), "accepted");
  p.domain = domain::Rectangle{.to = {0.5, 0.1}, .cells = {4, 1}};
  p.probes.clear();
  EXPECT_THAT(refusal_of(p, mode), HasSubstr("another domain"));
  p = test::with_chart(pushed_strip(), {"x", "y", "0.1*x^2"});
  EXPECT_THAT(refusal_of(p, mode), HasSubstr("another mid-surface"));
}

std::string refusal(const std::filesystem::path& path, std::size_t patches = 0) {
  try {
    static_cast<void>(read_mode(path, 1, patches));
  } catch (const UnusableResults& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Mode, IsRefusedIfItsFileIsNotWhole) {
  const ScratchDirectory scratch("damaged-modes");
  const FoundMode mode = first_mode(scratch);
  EXPECT_EQ(refusal(mode.file), "accepted");
  EXPECT_THAT(refusal(mode.file, 12), HasSubstr("belongs to a plane domain, the case has a mesh in space of 12 cells"));
  EXPECT_THAT(refusal(scratch.path / "none.mode"), HasSubstr("there is no such file"));
  if (world_size() > 1) return;  // the files below are written by one process
  std::ifstream stream(mode.file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  const auto refused = [&](const std::function<void(std::string&)>& change) {
    std::string text = whole;
    change(text);
    std::ofstream(scratch.path / "changed.mode", std::ios::binary) << text;
    return refusal(scratch.path / "changed.mode");
  };
  EXPECT_THAT(refused([](std::string& text) { text.resize(10); }), HasSubstr("too short"));
  EXPECT_THAT(refused([](std::string& text) { text.pop_back(); }), HasSubstr("incomplete or damaged"));
  EXPECT_THAT(refused([](std::string& text) { text[0] = 'X'; }), HasSubstr("not a mode of Plastron"));
  EXPECT_THAT(refused([](std::string& text) { text[8] = 9; }), HasSubstr("version 9"));
  EXPECT_THAT(refused([](std::string& text) { text[16] = 99; }), HasSubstr("impossible values"));
  EXPECT_THAT(refused([](std::string& text) { text.replace(text.size() - 8, 8, 8, '\xff'); }), HasSubstr("not finite"));
}

}  // namespace
}  // namespace plastron::io
