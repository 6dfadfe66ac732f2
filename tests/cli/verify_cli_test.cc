// plastron verify: an unchanged run passes, and any later change is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string plate = R"(title = "Plate of a mesh file"
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { mesh = "square.msh" }
chart = ["x", "y", "0.035"]
[[support]]
boundary = "edge"
fix = ["u", "r"]
[[load]]
force = [0, 0, -4e-4]
[[probe]]
name = "middle"
at = [0.5, 0.5]
)";
/// This shell is bent along itself, so cutting chords across it is worthwhile.
const std::string strip = R"(title = "Strip"
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { rectangle = { from = [0, 0], to = [3, 0.5] } }
chart = ["x", "y", "0.035"]
[[support]]
boundary = "left"
fix = ["u", "r"]
[[support]]
boundary = "right"
fix = ["u", "r"]
[[load]]
force = [0, 0, -4e-5]
[[probe]]
name = "middle"
at = [1.5, 0.25]
)";
const std::string plane = "[[obstacle]]\nhalf_space = { point = [0, 0, 0], normal = [0, 0, 1] }\n";
const std::string floor_and_ceiling =
    "[[obstacle]]\nname = \"floor\"\nface = \"lower\"\nhalf_space = { point = [0, 0, 0], normal = [0, 0, 1] }\n"
    "[[obstacle]]\nname = \"ceiling\"\nface = \"upper\"\nhalf_space = { point = [0, 0, 0.061], normal = [0, 0, -1] }\n";
const std::string ball = "[[obstacle]]\nball = { centre = [0.5, 0.5, -1], radius = 1 }\n";

std::string mesh(const std::string& more) { return "[mesh]\nrefinements = 2\n" + more; }

/// Three processes on two busy cores wait for each other [s].
constexpr double slow_seconds = 300;

/// A case that runs in its own directory.
struct Ran {
  explicit Ran(const std::string& text, const std::string& launcher = "") {
    fs::copy_file(PLASTRON_SOURCE_DIR "/tests/cli/wrong/square.msh", scratch.path / "square.msh");
    scratch.write("case.toml", text);
    const Outcome run = shell(launcher + "$PLASTRON run case.toml -q -o out", scratch.path, slow_seconds);
    exit_code = run.exit_code;
    output = run.output;
  }
  Outcome verify(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"verify", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return plastron(words, scratch.path, slow_seconds);
  }
  fs::path file(const std::string& name) const { return scratch.path / "out" / name; }

  Scratch scratch;
  int exit_code = -1;
  std::string output;
};

void expect_passed(const Ran& ran) {
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Outcome outcome = ran.verify();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(EndsWith("\nPASSED\n"), HasSubstr("stationarity"), HasSubstr("claimed"),
                                    HasSubstr("probes.middle.u[2]"), Not(HasSubstr("NO"))));
}

/// Exit code 3; the last line says which claim fails.
void expect_failed(const Ran& ran, const std::string& words) {
  const Outcome outcome = ran.verify();
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  const auto last = outcome.output.rfind("FAILED: ");
  ASSERT_NE(last, std::string::npos) << outcome.output;
  EXPECT_THAT(outcome.output.substr(last), HasSubstr(words));
  EXPECT_THAT(outcome.output, Not(HasSubstr("PASSED")));
}

/// Exit code 2; the words give the reason.
void expect_unusable(const Ran& ran, const std::string& words) {
  const Outcome outcome = ran.verify();
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(words));
  EXPECT_THAT(outcome.output, AllOf(Not(HasSubstr("PASSED")), Not(HasSubstr("FAILED"))));
}

void write_bytes(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// The middle node of the first cell that touches, or of the first cell. It belongs to no other cell.
std::size_t middle_node(const std::string& solution) {
  constexpr std::size_t header = 88 + 16, head = 64, node = 8 * 8, record = head + 9 * node, touching = 7 * 8;
  for (std::size_t at = header; at < solution.size(); at += record) {
    double touches = 0;
    const std::size_t middle = at + head + 4 * node;
    std::memcpy(&touches, solution.data() + middle + touching, sizeof touches);
    if (touches != 0) return middle;
  }
  ADD_FAILURE() << "nothing touches";
  return header + head + 4 * node;
}

/// Adds to a number of the solution: value k of the node.
void change_solution(const Ran& ran, std::size_t k, double by) {
  std::string solution = text_of(ran.file("solution.plastron"));
  double value = 0;
  char* at = solution.data() + middle_node(solution) + 8 * k;
  std::memcpy(&value, at, sizeof value);
  value += by;
  std::memcpy(at, &value, sizeof value);
  write_bytes(ran.file("solution.plastron"), solution);
}

template <class Edit>
void edit_results(const Ran& ran, const Edit& edit) {
  auto json = nlohmann::ordered_json::parse(text_of(ran.file("results.json")));
  edit(json);
  write_bytes(ran.file("results.json"), json.dump(2));
}

TEST(Verify, PassesEveryFormulationTrianglesAndCurvedObstacles) {
  for (const std::string formulation : {"penalised", "mixed", "classical"}) {
    std::string text = plate + plane + mesh("");
    text.insert(text.find("E = 1.0"), "formulation = \"" + formulation + "\"\n");
    expect_passed(Ran(text));
  }
  expect_passed(Ran(plate + plane + mesh("cells = \"triangle\"\n")));
  expect_passed(Ran(plate + ball + mesh("")));
  expect_passed(Ran(plate + floor_and_ceiling + mesh("")));
  expect_passed(Ran(plate + mesh("")));
}

TEST(Verify, PassesStepsAndPressedObstaclesAndSeesAnotherWay) {
  const std::string pressed_ball =
      "[[obstacle]]\nname = \"ball\"\nball = { centre = [0.5, 0.5, 0.6], radius = 0.5 }\nforce = [0, 0, -2e-6]\n";
  const std::string steps =
      "[[step]]\nparts = 2\n[[step.move]]\nobstacle = \"post\"\ntranslate = [0, 0, 0.001]\n[[step]]\nloads = 0.5\n";
  const std::string post = "[[obstacle]]\nname = \"post\"\nball = { centre = [0.2, 0.5, -0.5], radius = 0.5 }\n";
  expect_passed(Ran(plate + pressed_ball + mesh("")));
  const Ran ran(plate + post + pressed_ball + steps + mesh(""));
  expect_passed(ran);
  // The position of the ball follows the header and the two numbers of the post.
  std::string solution = text_of(ran.file("solution.plastron"));
  double way[2] = {};
  std::memcpy(way, solution.data() + 88 + 16, sizeof way);
  EXPECT_GT(std::abs(way[0] + way[1]), 1e-3);
  way[1] += 1e-3;
  std::memcpy(solution.data() + 88 + 16, way, sizeof way);
  write_bytes(ran.file("solution.plastron"), solution);
  expect_failed(ran, "");
}

TEST(Verify, PassesAdmissibleSolutionsAndRecomputesWhatTheyCost) {
  const std::string admissible = "[contact]\nadmissible = true\n";
  expect_passed(Ran(plate + plane + mesh("cells = \"triangle\"\n") + admissible));
  const Ran ran(plate + ball + mesh("") + admissible);
  expect_passed(ran);
  const auto json = nlohmann::ordered_json::parse(text_of(ran.file("results.json")));
  const auto& lifts = json["contact"]["admissible"];
  EXPECT_GT(lifts["rounds"], 0);
  EXPECT_GT(lifts["largest_lift"], 0);
  EXPECT_GT(lifts["lift_work"], 0);
  EXPECT_LT(json["contact"]["max_penetration_between_nodes"], 1e-10);
  edit_results(ran, [](auto& claimed) { claimed["contact"]["admissible"]["lift_work"] = 0; });
  expect_failed(ran, "claims contact.admissible.lift_work = 0");
}

TEST(Verify, SaysNothingWhenQuietButWhatFails) {
  const Ran ran(plate + plane + mesh(""));
  const Outcome good = ran.verify({"--quiet", "--threads", "1"});
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_THAT(good.output, IsEmpty());
  change_solution(ran, 2, 1e-4);
  const Outcome bad = ran.verify({"--quiet"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.output, testing::StartsWith("FAILED: stationarity"));
}

TEST(Verify, NamesTheRowWhereTheSolutionWasChanged) {
  for (const std::size_t value : {2u, 3u, 6u}) {  // u_z, r_x, eta
    const Ran ran(plate + plane + mesh(""));
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
    change_solution(ran, value, 1e-4);
    expect_failed(ran, "stationarity is");
  }
  const Ran ran(plate + plane + mesh(""));
  change_solution(ran, 5, 1e-2);
  expect_failed(ran, "space_error is");
}

TEST(Verify, NamesTheNumberOfTheResultsThatWasChanged) {
  const Ran ran(plate + plane + mesh(""));
  const std::string good = text_of(ran.file("results.json"));
  const std::vector<std::pair<std::string, std::string>> numbers{
      {"/energy", "energy"},
      {"/reaction/force/2", "reaction.force[2]"},
      {"/contact/area", "contact.area"},
      {"/contact/nodes", "contact.nodes"},
      {"/probes/middle/u/2", "probes.middle.u[2]"},
      {"/certificate/moment_balance", "certificate.moment_balance"},
      {"/certificate_limits/stationarity/at_most", "certificate_limits.stationarity.at_most"},
      {"/settings/shell/thickness", "settings.shell.thickness"},
      {"/levels/2/unknowns", "levels[last].unknowns"}};
  for (const auto& [pointer, name] : numbers) {
    edit_results(ran, [&](auto& json) {
      auto& number = json.at(nlohmann::ordered_json::json_pointer(pointer));
      if (number.is_number_integer())
        number = number.template get<int>() + 1;
      else
        number = 1.0001 * number.template get<double>() + 1e-5;
    });
    expect_failed(ran, "claims " + name + " = ");
    write_bytes(ran.file("results.json"), good);
  }
  EXPECT_EQ(ran.verify().exit_code, 0);
}

TEST(Verify, FailsResultsThatAreNotSolved) {
  const Ran ran(plate + plane + mesh("") + "[solver]\nmax_iterations = 1\n");
  ASSERT_EQ(ran.exit_code, 3) << ran.output;
  expect_failed(ran, "the status of these results is \"iteration_limit\"");
  edit_results(ran, [](auto& json) { json["status"] = "solved"; });
  expect_failed(ran, "its limit");
}

TEST(Verify, RefusesWhatIsDamaged) {
  const Ran ran(plate + plane + mesh(""));
  const std::string solution = text_of(ran.file("solution.plastron")), results = text_of(ran.file("results.json"));
  write_bytes(ran.file("solution.plastron"), solution.substr(0, solution.size() / 2));
  expect_unusable(ran, "incomplete");
  fs::remove(ran.file("solution.plastron"));
  expect_unusable(ran, "there is no such file");
  write_bytes(ran.file("solution.plastron"), solution);
  write_bytes(ran.file("results.json"), results.substr(0, 1000));
  expect_unusable(ran, "not JSON");
  write_bytes(ran.file("results.json"), results);
  EXPECT_EQ(ran.verify().exit_code, 0);
  fs::remove(ran.file("results.json"));
  expect_unusable(ran, "no results.json");
  EXPECT_EQ(plastron({"verify", "nowhere"}, ran.scratch.path).exit_code, 2);
  EXPECT_EQ(plastron({"verify"}, ran.scratch.path).exit_code, 2);
}

TEST(Verify, NoticesFilesThatHaveChanged) {
  const Ran ran(plate + plane + mesh(""));
  const std::string square = text_of(ran.scratch.path / "square.msh"), copy = text_of(ran.file("solution.case.toml"));
  EXPECT_EQ(copy, text_of(ran.scratch.path / "case.toml"));
  write_bytes(ran.scratch.path / "case.toml", "the original may change: the copy counts");
  EXPECT_EQ(ran.verify().exit_code, 0);
  write_bytes(ran.scratch.path / "square.msh", square + "\n");
  expect_unusable(ran, "the file \"square.msh\" that the case names has changed");
  fs::remove(ran.scratch.path / "square.msh");
  expect_unusable(ran, "square.msh");
  fs::create_directory(ran.scratch.path / "elsewhere");
  write_bytes(ran.scratch.path / "elsewhere/square.msh", square);
  EXPECT_EQ(ran.verify({"--files", "elsewhere"}).exit_code, 0);
  write_bytes(ran.scratch.path / "square.msh", square);
  write_bytes(ran.file("solution.case.toml"), copy + "# a word\n");
  expect_unusable(ran, "the copy of the case has changed");
}

TEST(Verify, NamesEveryFileThatHasChangedAndSaysWhatAChecksumAloneCovers) {
  const Ran ran(plate + plane + mesh(""));
  EXPECT_THAT(ran.verify().output, HasSubstr("10 of 10 files have the SHA-256 that run stored"));
  for (const std::string name : {"report.html", "solution.vtu", "contact-forces.csv", "solution.pvd"}) {
    const std::string good = text_of(ran.file(name));
    write_bytes(ran.file(name), good + " ");
    expect_failed(ran, name + " is not the file");
    fs::remove(ran.file(name));
    expect_failed(ran, name + " is missing");
    write_bytes(ran.file(name), good);
  }
  const std::string good = text_of(ran.file("results.json"));
  for (const char* part : {"/title", "/warnings", "/estimates", "/levels/0/energy"}) {
    edit_results(ran, [&](auto& json) { json[nlohmann::ordered_json::json_pointer(part)] = "another"; });
    expect_failed(ran, "results.json is not the file");
    write_bytes(ran.file("results.json"), good);
  }
  EXPECT_EQ(ran.verify().exit_code, 0);
  fs::remove(ran.file("SHA256SUMS"));
  expect_unusable(ran, "there is no SHA256SUMS");
}

TEST(Verify, RefusesANodeThatTouchesALittle) {
  const Ran ran(plate + plane + mesh(""));
  change_solution(ran, 7, -0.5);
  expect_unusable(ran, "it can be 0 or 1");
}

TEST(Verify, TakesOnAnyNumberOfRanksWhatAnyNumberHasWritten) {
  const std::string of_three =
      "export OMPI_MCA_mpi_yield_when_idle=1; unset OMPI_MCA_ess_singleton_isolated "
      "OMPI_MCA_pml OMPI_MCA_btl; " MPIEXEC " --oversubscribe -n 3 ";
  expect_passed(Ran(plate + plane + mesh(""), of_three));
  const Ran cut(strip + plane + "[accuracy]\nenergy = 1e-3\n", of_three);
  std::int64_t numbers_of_cuts = 0;
  std::memcpy(&numbers_of_cuts, text_of(cut.file("solution.plastron")).substr(64, 8).data(), 8);
  EXPECT_GT(numbers_of_cuts, 0);
  expect_passed(cut);
  const Ran ran(plate + plane + mesh(""));
  const Outcome outcome = shell(of_three + "$PLASTRON verify out", ran.scratch.path, slow_seconds);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, EndsWith("\nPASSED\n"));
  change_solution(ran, 2, 1e-4);
  const Outcome failed = shell(of_three + "$PLASTRON verify out", ran.scratch.path, slow_seconds);
  EXPECT_EQ(failed.exit_code, 3) << failed.output;
  EXPECT_THAT(failed.output, HasSubstr("FAILED: stationarity"));
}

}  // namespace
}  // namespace plastron::cli
