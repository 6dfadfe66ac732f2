#include <plastron/workflow/output.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>
#include <io/vtu_reader.hpp>

#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace plastron::workflow {

namespace {

using namespace io;  // NOLINT: what files are made of, and helpers of tests
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

/// The files of a run with contact.
const std::vector<std::string> all_files{
    "results.json",         "solution.vtu",         "obstacles.vtu",      "solution.pvd", "solution.plastron",
    "contact-boundary.csv", "contact-boundary.vtu", "contact-forces.csv", "report.html",  "SHA256SUMS"};

TEST(Output, of_a_solved_problem_is_files_that_agree) {
  const ScratchDirectory scratch("output");
  const computation::Result result = computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  write_output(result, {.title = "plate", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  EXPECT_THAT(scratch.names(), UnorderedElementsAreArray(all_files));
  const Json json = Json::parse(text_of(scratch.path / "results.json"));
  EXPECT_EQ(json["files"],
            Json({"solution.vtu", "obstacles.vtu", "solution.plastron", "solution.pvd", "contact-boundary.csv",
                  "contact-boundary.vtu", "contact-forces.csv", "report.html", "SHA256SUMS"}));
  EXPECT_EQ(json["status"], Json("solved"));
  EXPECT_EQ(json["ranks"], Json(world_size()));
  EXPECT_EQ(json["levels"].back()["cells"], Json(read_vtu(scratch.path / "solution.vtu").cells));
  for (const Json& file : json["files"]) EXPECT_TRUE(std::filesystem::exists(scratch.path / file.get<std::string>()));
  const std::string series = text_of(scratch.path / "solution.pvd");
  EXPECT_NE(series.find("part=\"0\" file=\"solution.vtu\""), std::string::npos);
  EXPECT_NE(series.find("part=\"1\" file=\"obstacles.vtu\""), std::string::npos);
  const std::string table = text_of(scratch.path / "obstacles.vtu");  // a half-space is a rectangle
  EXPECT_NE(table.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""), std::string::npos);
}

TEST(Output, of_steps_has_a_file_of_fields_for_each_instant_and_their_history) {
  const ScratchDirectory scratch("steps");
  problem::Problem problem = pressed_plate({.degree = 2, .refinements = 1});
  problem.steps = {{.name = "press, slowly", .parts = 3}};
  Output output(scratch.path, "solution", MPI_COMM_WORLD);
  const computation::Result result = computation::solve(
      problem, MPI_COMM_WORLD,
      {.instant = [&](const auto& entry, const auto& solution) { output.add_instant(entry, solution); }});
  output.finish(result, {.title = "plate", .settings = {}, .files = {}});
  EXPECT_THAT(scratch.names(),
              UnorderedElementsAre("results.json", "solution-0001.vtu", "solution-0002.vtu", "solution-0003.vtu",
                                   "obstacles-0001.vtu", "obstacles-0002.vtu", "obstacles-0003.vtu", "obstacles.vtu",
                                   "solution.vtu", "solution.plastron", "solution.pvd", "contact-boundary.csv",
                                   "contact-boundary.vtu", "contact-forces.csv", "history.csv", "history.svg",
                                   "report.html", "SHA256SUMS"));
  EXPECT_EQ(text_of(scratch.path / "solution-0003.vtu"), text_of(scratch.path / "solution.vtu"));
  EXPECT_NE(text_of(scratch.path / "solution-0001.vtu"), text_of(scratch.path / "solution.vtu"));
  EXPECT_NE(text_of(scratch.path / "solution.pvd").find("timestep=\"1\" part=\"0\" file=\"solution-0003.vtu\""),
            std::string::npos);
  const Json history = Json::parse(text_of(scratch.path / "results.json"))["history"];
  ASSERT_EQ(history.size(), 3U);
  EXPECT_EQ(history[2]["step"], Json("press, slowly"));
  EXPECT_NEAR(history[2]["energy"].get<double>(), result.summary.energy.total(), 0);
  // The table: a line of names, then one line for each instant with as many values.
  std::istringstream table(text_of(scratch.path / "history.csv"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(table, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0].rfind("time,step,status,load_factor,controlled_displacement,support_factor,energy,", 0), 0U);
  EXPECT_EQ(lines[3].rfind("1.0,\"press, slowly\",solved,1.0,", 0), 0U);
  EXPECT_THAT(lines[0],
              testing::AllOf(testing::HasSubstr("probes.centre.N_11,probes.centre.N_22,probes.centre.N_12"),
                             testing::HasSubstr("probes.centre.u_x"), testing::Not(testing::HasSubstr("N_x"))));
  const auto commas = [](const std::string& line) { return std::ranges::count(line, ','); };
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(commas(lines[i]), commas(lines[0]) + 1);  // one is in the name
}

/// Two load cases of the plate without obstacle: the second one has -1/2 of the loads of the first.
problem::Problem two_cases(int refinements) {
  problem::Problem problem = pressed_plate({.refinements = refinements, .obstacle = false});
  problem.steps = {{.name = "down"}, {.name = "up"}};
  problem.steps.back().factors.loads = -0.5;
  problem.steps_are_cases = true;
  return problem;
}

TEST(Output, of_an_envelope_has_the_extreme_values_of_each_field_and_their_cases) {
  const ScratchDirectory scratch("envelope");
  Output output(scratch.path, "solution", MPI_COMM_WORLD, false,
                {.envelopes = {{"both", {"down", "up"}}, {"upwards", {"up"}}, {"never", {"up", "sideways"}}}});
  const computation::Result result = computation::solve(
      two_cases(1), MPI_COMM_WORLD,
      {.instant = [&](const auto& entry, const auto& solution) { output.add_instant(entry, solution); }});
  EXPECT_THAT(output.finish(result, {}),
              testing::AllOf(testing::Contains("envelope-both.vtu"), testing::Contains("envelope-upwards.vtu"),
                             testing::Not(testing::Contains("envelope-never.vtu"))));
  const VtuFile both = read_vtu(scratch.path / "envelope-both.vtu");
  const std::array cases{read_vtu(scratch.path / "solution-0001.vtu"), read_vtu(scratch.path / "solution-0002.vtu")};
  EXPECT_EQ(both.cells, cases[0].cells);
  EXPECT_EQ(both.arrays.at("points").values, cases[0].arrays.at("reference position").values);
  EXPECT_EQ(both.arrays.count("thickness_least"), 0U);
  EXPECT_EQ(both.arrays.at("M_11_least").unit, "N");
  for (const std::string name : {"displacement", "M_11", "von_mises_upper"}) {
    const auto& first = cases[0].arrays.at(name).values;
    const auto& second = cases[1].arrays.at(name).values;
    for (const bool is_least : {true, false}) {
      const std::string extreme = name + (is_least ? "_least" : "_largest");
      const auto& values = both.arrays.at(extreme).values;
      const auto& of_case = both.arrays.at(extreme + "_case").values;
      ASSERT_EQ(values.size(), first.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(values[i], is_least ? std::min(first[i], second[i]) : std::max(first[i], second[i])) << extreme;
        EXPECT_EQ(values[i], (of_case[i] == 0 ? first : second)[i]) << extreme;
      }
      EXPECT_THAT(of_case, testing::Each(testing::AnyOf(0.0, 1.0)));
      if (name == "M_11") {  // both signs occur
        EXPECT_THAT(of_case, testing::AllOf(testing::Contains(0.0), testing::Contains(1.0)));
      }
    }
  }
}

TEST(Output, of_an_envelope_over_different_meshes_has_no_fields) {
  const ScratchDirectory scratch("envelope-of-meshes");
  Output output(scratch.path, "solution", MPI_COMM_WORLD, false, {.envelopes = {{"both", {"coarse", "fine"}}}});
  computation::Result result;
  for (const char* name : {"coarse", "fine"}) {
    result = computation::solve(two_cases(result.solution ? 1 : 0), MPI_COMM_WORLD);
    computation::HistoryEntry entry;
    entry.step = name;
    output.add_instant(entry, *result.solution);
  }
  EXPECT_THAT(output.warnings(), testing::ElementsAre(testing::HasSubstr("the meshes of its load cases differ")));
  EXPECT_THAT(output.finish(result, {}), testing::Not(testing::Contains("envelope-both.vtu")));
}

TEST(Output, the_resultants_of_results_json_balance) {
  const computation::Result result = computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  const Json json = results_json(result, {});
  double sum = 0;
  for (const char* part : {"loads", "reaction", "support_reaction"}) sum += json[part]["force"][2].get<double>();
  EXPECT_NEAR(sum, 0, 1e-8 * -json["loads"]["force"][2].get<double>());
}

TEST(Output, makes_its_directory) {
  const ScratchDirectory scratch("deep");
  write_output({}, {}, scratch.path / "a" / "b", "solution", MPI_COMM_WORLD);
  EXPECT_TRUE(std::filesystem::exists(scratch.path / "a" / "b" / "results.json"));
}

TEST(Output, of_displacements_that_are_not_finite_has_no_surface) {
  const ScratchDirectory scratch("nan");
  computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  const auto y = result.solution->nodal.y.owned();
  if (!y.empty()) y[0] = std::numeric_limits<double>::quiet_NaN();
  write_output(result, {}, scratch.path, "solution", MPI_COMM_WORLD);
  EXPECT_THAT(scratch.names(), UnorderedElementsAre("results.json", "report.html", "SHA256SUMS"));
}

TEST(Output, that_fails_keeps_the_results_of_an_earlier_run) {
  const ScratchDirectory scratch("stale");
  const computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  write_output(result, {.title = "first", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  const std::string before = text_of(scratch.path / "results.json");
  MPI_Barrier(MPI_COMM_WORLD);
  if (world_rank() == 0) {  // a directory has the name of the .vtu file
    std::filesystem::remove(scratch.path / "solution.vtu");
    std::filesystem::create_directory(scratch.path / "solution.vtu");
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(
      write_output(result, {.title = "second", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD),
      std::runtime_error);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(text_of(scratch.path / "results.json"), before);
  EXPECT_THAT(scratch.names(), UnorderedElementsAreArray(all_files));
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Output, that_failed_is_written_once_the_reason_is_gone) {
  const ScratchDirectory scratch("again");
  const computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  const auto in_the_way = scratch.path / "contact-forces.csv";
  if (world_rank() == 0) std::filesystem::create_directory(in_the_way);
  MPI_Barrier(MPI_COMM_WORLD);
  Output output(scratch.path, "solution", MPI_COMM_WORLD);
  EXPECT_THROW(output.finish(result, {}), std::runtime_error);
  if (world_rank() == 0) std::filesystem::remove(in_the_way);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THAT(output.finish(result, {}), UnorderedElementsAreArray(all_files));
  EXPECT_THAT(scratch.names(), UnorderedElementsAreArray(all_files));
  MPI_Barrier(MPI_COMM_WORLD);
}

/// The events in a directory: "- NAME" when a file is removed, "+ NAME" when one gets its name.
class Watch {
 public:
  explicit Watch(const std::filesystem::path& directory) : descriptor_(inotify_init1(IN_NONBLOCK)) {
    inotify_add_watch(descriptor_, directory.c_str(), IN_MOVED_TO | IN_DELETE);
  }
  ~Watch() { close(descriptor_); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  std::vector<std::string> events() const {
    alignas(inotify_event) std::array<char, 1 << 16> bytes{};
    const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
    std::vector<std::string> all;
    for (ssize_t at = 0; at < count;) {
      const auto* event = reinterpret_cast<const inotify_event*>(bytes.data() + at);
      if (!std::string(event->name).starts_with(".plastron"))
        all.push_back(((event->mask & IN_DELETE) ? "- " : "+ ") + std::string(event->name));
      at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
    }
    return all;
  }

 private:
  int descriptor_;
};

TEST(Output, takes_results_json_away_before_the_first_file_is_replaced_and_writes_it_last) {
  const ScratchDirectory scratch("order");
  const computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  write_output(result, {.title = "first", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  MPI_Barrier(MPI_COMM_WORLD);
  const Watch watch(scratch.path);
  write_output(result, {.title = "second", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  MPI_Barrier(MPI_COMM_WORLD);
  const std::vector<std::string> events = watch.events();
  ASSERT_EQ(events.size(), all_files.size() + 1);
  EXPECT_EQ(events.front(), "- results.json");
  EXPECT_EQ(events.back(), "+ results.json");
}

TEST(Output, has_the_checksums_of_all_other_files) {
  const ScratchDirectory scratch("checksums");
  const computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  write_output(result, {.title = "plate", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  std::string sums = text_of(scratch.path / "SHA256SUMS");
  for (const std::string& name : all_files) {
    if (name == "SHA256SUMS") continue;
    EXPECT_NE(sums.find(checksum_of_file(scratch.path / name).hash + "  " + name + "\n"), std::string::npos) << name;
  }
  EXPECT_EQ(std::ranges::count(sums, '\n'), static_cast<long>(all_files.size()) - 1);
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Output, on_a_disk_that_is_full_keeps_the_results_of_an_earlier_run) {
  const ScratchDirectory scratch("full-output");
  const computation::Result result = computation::solve(pressed_plate({.refinements = 0}), MPI_COMM_WORLD);
  write_output(result, {.title = "first", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  const std::string results = text_of(scratch.path / "results.json"), surface = text_of(scratch.path / "solution.vtu");
  const auto report = std::filesystem::file_size(scratch.path / "report.html");
  ASSERT_GT(report, surface.size());
  for (const std::uintmax_t bytes : {std::uintmax_t{surface.size() - 1}, report - 1}) {
    {
      const FileSizeLimit full(bytes);
      EXPECT_THROW(write_output(result, {.title = "second", .settings = {}, .files = {}}, scratch.path, "solution",
                                MPI_COMM_WORLD),
                   std::runtime_error);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(text_of(scratch.path / "results.json"), results);
    EXPECT_EQ(text_of(scratch.path / "solution.vtu"), surface);
    EXPECT_THAT(scratch.names(), UnorderedElementsAreArray(all_files));
    MPI_Barrier(MPI_COMM_WORLD);
  }
}

}  // namespace

}  // namespace plastron::workflow
