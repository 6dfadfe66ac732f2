// --set and --json-log on the program itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <set>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

/// The rollers case of `plastron new`, with steps, on two given meshes.
fs::path rollers(const Scratch& scratch) {
  const fs::path file = scratch.path / "rollers.toml";
  EXPECT_EQ(plastron({"new", "rollers.toml", "--template", "rollers"}, scratch.path).exit_code, 0);
  std::string text = text_of(file);
  const std::size_t begin = text.find("[accuracy]"), end = text.find("\n[", begin);
  EXPECT_NE(end, std::string::npos);
  text.replace(begin, end - begin, "[mesh]\ndegree = 4\nrefinements = 1\n");
  std::ofstream(file) << text;
  return file;
}

nlohmann::json results_in(const fs::path& directory) {
  return nlohmann::json::parse(text_of(directory / "results.json"));
}

const std::vector<std::string> settings{"--set", "mesh.refinements=0",      "--set", "obstacle[2].force=[0,0,-0.05]",
                                        "--set", "solver.max_iterations=50"};

std::vector<std::string> with_settings(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  return arguments;
}

TEST(Settings, TakeThePlaceOfKeysAndAreRecorded) {
  const Scratch scratch;
  const std::string original = text_of(rollers(scratch));
  const Outcome run = plastron(with_settings({"run", "rollers.toml", "--output", "out"}), scratch.path);
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto results = results_in(scratch.path / "out");
  EXPECT_EQ(results["settings"]["mesh"]["refinements"], 0);
  EXPECT_EQ(results["settings"]["solver"]["max_iterations"], 50);
  EXPECT_EQ(results["levels"].size(), 1u);
  EXPECT_NEAR(results["obstacles"][2]["reaction"]["force"][2].get<double>(), -0.05, 1e-9);
  EXPECT_THAT(results["verification"]["case"]["set"],
              ElementsAre("mesh.refinements=0", "obstacle[2].force=[0,0,-0.05]", "solver.max_iterations=50"));
  EXPECT_EQ(text_of(scratch.path / "rollers.toml"), original);
  EXPECT_THAT(text_of(scratch.path / "out/solution.case.toml"),
              AllOf(HasSubstr("# --set mesh.refinements=0\n"), HasSubstr("[solver]\nmax_iterations = 50\n")));
}

TEST(Settings, LeaveResultsThatVerify) {
  const Scratch scratch;
  rollers(scratch);
  ASSERT_EQ(plastron(with_settings({"run", "rollers.toml", "--output", "out", "-q"}), scratch.path).exit_code, 0);
  const Outcome verified = plastron({"verify", "out"}, scratch.path);
  EXPECT_EQ(verified.exit_code, 0) << verified.output;
  EXPECT_THAT(verified.output, HasSubstr("PASSED"));
  // The copy is a normal case with the same outcome. Only the comments at its top differ.
  ASSERT_EQ(plastron({"run", "out/solution.case.toml", "--output", "again", "-q"}, scratch.path).exit_code, 0);
  EXPECT_EQ(results_in(scratch.path / "again")["energy"], results_in(scratch.path / "out")["energy"]);
}

TEST(Settings, AreTakenByCheckAndStudyToo) {
  const Scratch scratch;
  rollers(scratch);
  const Outcome check = plastron({"check", "rollers.toml", "--set", "title=\"Other\""}, scratch.path);
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_THAT(check.output, HasSubstr("rollers.toml: Other"));
  const Outcome study =
      plastron({"study", "soft-modes", "rollers.toml", "--set", "mesh.refinements=0", "--output", "out"}, scratch.path);
  EXPECT_EQ(study.exit_code, 0) << study.output;
  const auto report = nlohmann::json::parse(text_of(scratch.path / "out/soft-modes.json"));
  EXPECT_EQ(report["settings"]["mesh"]["refinements"], 0);
}

TEST(Settings, ThatAreWrongAreNamedAtOnce) {
  const Scratch scratch;
  rollers(scratch);
  for (const char* command : {"run", "check", "study"}) {
    std::vector<std::string> arguments{command};
    if (arguments[0] == "study") arguments.emplace_back("penalty");
    arguments.insert(arguments.end(), {"rollers.toml", "--set", "shell.thickness=-1"});
    if (arguments[0] != "check") arguments.insert(arguments.end(), {"--output", "out"});
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr("--set shell.thickness=-1: error: thickness is -1, out of range"));
    EXPECT_FALSE(fs::exists(scratch.path / "out"));
  }
}

// ---- --json-log ------------------------------------------------------------------------------------------------

/// Standard error of a shell command; every line of it is JSON.
std::vector<nlohmann::json> events(const Scratch& scratch, const std::string& line, int exit_code) {
  EXPECT_EQ(shell(line + " 2>events.log >/dev/null", scratch.path).exit_code, exit_code);
  std::vector<nlohmann::json> all;
  std::istringstream lines(text_of(scratch.path / "events.log"));
  for (std::string text; std::getline(lines, text);) {
    all.push_back(nlohmann::json::parse(text, nullptr, false));
    EXPECT_FALSE(all.back().is_discarded()) << text;
    EXPECT_TRUE(all.back().contains("event") && all.back()["time"].is_number()) << text;
  }
  return all;
}

std::vector<std::string> names(const std::vector<nlohmann::json>& events) {
  std::vector<std::string> all;
  for (const auto& event : events) all.push_back(event["event"]);
  return all;
}

const nlohmann::json& first(const std::vector<nlohmann::json>& events, const std::string& name) {
  for (const auto& event : events)
    if (event["event"] == name) return event;
  throw std::runtime_error("no event " + name);
}

TEST(EventLog, TellsOfARunFromBeginningToEnd) {
  const Scratch scratch;
  rollers(scratch);
  const auto log = events(scratch, "$PLASTRON run rollers.toml -o out --json-log", 0);
  EXPECT_THAT(names(log),
              IsSupersetOf({"start", "level_begin", "phase", "iteration", "level_end", "file", "status", "exit"}));
  EXPECT_EQ(log.front()["event"], "start");
  EXPECT_EQ(log.front()["case"], "rollers.toml");
  EXPECT_EQ(log.back()["event"], "exit");
  EXPECT_EQ(log.back()["exit_code"], 0);
  EXPECT_EQ(first(log, "status")["status"], "solved");
  const auto results = results_in(scratch.path / "out");
  EXPECT_EQ(first(log, "level_end")["energy"], results["levels"][0]["energy"]);
  EXPECT_EQ(std::ranges::count(names(log), "level_begin"), std::ssize(results["levels"]));
  std::set<std::string> written;
  for (const auto& event : log)
    if (event["event"] == "file") written.insert(fs::path(event["path"].get<std::string>()).filename());
  for (const std::string& file : files_below(scratch.path / "out")) EXPECT_TRUE(written.contains(file)) << file;
}

TEST(EventLog, HasWarningsAndStepsAndStudies) {
  const Scratch scratch;
  ASSERT_EQ(plastron({"new", "dome.toml", "-t", "dome"}, scratch.path).exit_code, 0);
  const std::string small = R"( --json-log --set mesh.refinements=0 --set 'shell.rotations="small"' )";
  const auto log = events(scratch, "$PLASTRON run dome.toml -o out -q --set constants.F=2e-3" + small, 0);
  EXPECT_EQ(std::ranges::count(names(log), "instant"), 4);
  EXPECT_THAT(first(log, "warning")["text"].get<std::string>(), HasSubstr("linear model"));
  const auto study = events(scratch, "$PLASTRON study soft-modes dome.toml -o study --set mesh.degree=2" + small, 0);
  EXPECT_THAT(names(study), IsSupersetOf({"start", "stage", "file", "status", "exit"}));
}

TEST(EventLog, HasMistakesAsEvents) {
  const Scratch scratch;
  rollers(scratch);
  const auto log = events(scratch, "$PLASTRON run rollers.toml -o out --json-log --set shell.nu=2", 2);
  EXPECT_THAT(names(log), ElementsAre("start", "mistake", "exit"));
  EXPECT_THAT(log[1]["what"].get<std::string>(), HasSubstr("nu is 2"));
  EXPECT_EQ(log[1]["file"], "--set shell.nu=2");
  EXPECT_EQ(log[2]["exit_code"], 2);
  scratch.write("occupied", "");
  const auto refused = events(scratch, "$PLASTRON run rollers.toml -o occupied --json-log", 2);
  EXPECT_THAT(first(refused, "error")["text"].get<std::string>(), HasSubstr("cannot be written"));
}

// ---- progress on a terminal ------------------------------------------------------------------------------------

TEST(StatusLine, IsThereOnATerminalOnly) {
  const Scratch scratch;
  rollers(scratch);
  const Outcome piped = shell("$PLASTRON run rollers.toml -o out", scratch.path);
  EXPECT_THAT(piped.output, Not(HasSubstr("\r")));
  const Outcome on_terminal = shell("script -qec \"$PLASTRON run rollers.toml -o out\" /dev/null", scratch.path);
  EXPECT_EQ(on_terminal.exit_code, 0) << on_terminal.output;
  EXPECT_THAT(on_terminal.output, AllOf(HasSubstr("\rlevel 0 of 1: "), HasSubstr("nodes in contact")));
  const Outcome logged = shell("script -qec \"$PLASTRON run rollers.toml -o out --json-log\" /dev/null", scratch.path);
  EXPECT_THAT(logged.output, Not(HasSubstr("\rlevel")));
}

}  // namespace
}  // namespace plastron::cli
