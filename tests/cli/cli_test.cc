// The command line: exit codes, files, interruptions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string strip = R"(title = "Pressed strip"
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { rectangle = { to = [1, 0.125], cells = [8, 1] } }
chart = ["x", "y", "0.035"]
[[support]]
boundary = "left"
fix = ["u", "r"]
[[support]]
boundary = "right"
fix = ["u", "r"]
[[support]]
boundary = "bottom"
fix = ["u.y", "r.y"]
[[support]]
boundary = "top"
fix = ["u.y", "r.y"]
[[load]]
force = [0, 0, -4e-3]
[[obstacle]]
half_space = { point = [0, 0, 0], normal = [0, 0, 1] }
[[probe]]
name = "middle"
at = [0.5, 0.0625]
)";

std::string case_with(int refinements, const std::string& more = "") {
  return strip + "[mesh]\ndegree = 2\nrefinements = " + std::to_string(refinements) + "\n" + more;
}

nlohmann::json results_in(const fs::path& directory) {
  return nlohmann::json::parse(text_of(directory / "results.json"));
}

std::vector<std::string> with_extension(const std::vector<std::string>& files, const std::string& extension) {
  std::vector<std::string> some;
  for (const std::string& f : files)
    if (f.ends_with(extension)) some.push_back(f);
  return some;
}

// ---- the command line itself ---------------------------------------------------------------------------------------

TEST(CommandLine, tells_its_version_and_its_help) {
  const Scratch scratch;
  const Outcome version = plastron({"--version"}, scratch.path), help = plastron({"--help"}, scratch.path);
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.output, HasSubstr(PLASTRON_BUILD_VERSION));
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.output, AllOf(HasSubstr("run"), HasSubstr("check"), HasSubstr("Exit codes")));
  EXPECT_EQ(plastron({"run", "--help"}, scratch.path).exit_code, 0);
}

TEST(CommandLine, that_is_wrong_is_bad_input) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", case_with(0)).string();
  const std::vector<std::vector<std::string>> wrong{{},
                                                    {"solve", file},
                                                    {"run"},
                                                    {"run", file},
                                                    {"run", file, "--output"},
                                                    {"run", file, "-o", "X", "--fast"},
                                                    {"check"},
                                                    {"check", file, "--output", "X"},
                                                    {"check", file, file},
                                                    {"--fast"}};
  for (const auto& arguments : wrong) {
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments) << "\n" << outcome.output;
    EXPECT_NE(outcome.output, "");
  }
  EXPECT_FALSE(fs::exists(scratch.path / "X"));
}

TEST(CaseFile, that_cannot_be_read_is_bad_input) {
  const Scratch scratch;
  for (const std::string command : {"check", "run"})
    for (const std::string& file : {std::string("no-such.toml"), scratch.path.string()}) {
      std::vector<std::string> arguments{command, file};
      if (command == "run") arguments.insert(arguments.end(), {"-o", "X"});
      const Outcome outcome = plastron(arguments, scratch.path);
      EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
      EXPECT_THAT(outcome.output, HasSubstr(file));
    }
  EXPECT_TRUE(fs::is_empty(scratch.path));
}

// ---- a good case ---------------------------------------------------------------------------------------------------

TEST(GoodCase, is_ready_to_run) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(1));
  const Outcome outcome = plastron({"check", "case.toml"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("Pressed strip"), HasSubstr("no rigid motion"), HasSubstr("ready to run")));
  EXPECT_THAT(files_below(scratch.path), ElementsAre("case.toml"));
}

TEST(GoodCase, prints_its_levels_and_writes_its_results) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(1));
  const Outcome outcome = plastron({"run", "case.toml", "--output", "out"}, scratch.path);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("Pressed strip"), HasSubstr("unknowns"), HasSubstr("certificate"),
                                    HasSubstr("probe middle")));
  const auto files = files_below(scratch.path / "out");
  EXPECT_THAT(files, Contains("results.json"));
  EXPECT_FALSE(with_extension(files, ".vtu").empty());
  EXPECT_FALSE(with_extension(files, ".pvd").empty());
  const auto results = results_in(scratch.path / "out");
  EXPECT_EQ(results.at("status"), "solved");
  EXPECT_EQ(results.at("levels").size(), 2u);
}

TEST(Modes, are_six_of_both_unless_the_case_or_the_command_says_otherwise) {
  const Scratch scratch;
  std::string with_density = case_with(0);
  with_density.replace(with_density.find("nu = 0.3"), 8, "nu = 0.3\ndensity = 1.0");
  scratch.write("light.toml", case_with(0));
  scratch.write("case.toml", with_density);
  const auto count = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    std::pair<int, int> numbers{0, 0};
    const auto results = results_in(scratch.path / "out");
    for (const auto& mode : results.at("modes")) ++(mode.at("frequency").is_null() ? numbers.first : numbers.second);
    return numbers;
  };
  EXPECT_EQ(count({"modes", "case.toml", "-o", "out"}), std::pair(6, 6));
  EXPECT_EQ(count({"modes", "light.toml", "-o", "out"}), std::pair(6, 0));
  EXPECT_EQ(count({"modes", "case.toml", "-o", "out", "--buckling", "0", "--vibration", "2"}), std::pair(0, 2));
  EXPECT_EQ(count({"run", "case.toml", "-o", "out"}), std::pair(0, 0));
  EXPECT_EQ(plastron({"verify", "out"}, scratch.path).exit_code, 0);
  const Outcome wrong = plastron({"modes", "light.toml", "-o", "no", "--vibration", "2"}, scratch.path);
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.output, HasSubstr("density"));
  EXPECT_FALSE(fs::exists(scratch.path / "no"));
}

TEST(GoodCase, may_name_its_units_which_does_not_change_its_title) {
  const Scratch scratch;
  const std::string given = "title = \"Pressed strip", named = "title = \"Strip of 5 m";
  std::string text = case_with(1, "[units]\nlength = \"mm\"\n");
  text.replace(text.find(given), given.size(), named);
  scratch.write("case.toml", text);
  const Outcome check = plastron({"check", "case.toml"}, scratch.path);
  EXPECT_THAT(check.output, AllOf(HasSubstr("case.toml: Strip of 5 m\n"), HasSubstr("mm^2"), Not(HasSubstr(" m^2"))));
  const Outcome run = plastron({"run", "case.toml", "--output", "out"}, scratch.path);
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("Strip of 5 m\n"), HasSubstr("min gap [mm]"), HasSubstr(" MPa"),
                                HasSubstr(" mJ"), Not(HasSubstr(" Pa"))));
  const Outcome verify = plastron({"verify", "out"}, scratch.path);
  EXPECT_EQ(verify.exit_code, 0) << verify.output;
  EXPECT_THAT(verify.output, AllOf(HasSubstr("Strip of 5 m\n"), HasSubstr("PASSED")));
}

TEST(Compare, sets_solvers_side_by_side_with_files_or_without) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(1));
  const Outcome printed = plastron({"compare", "--solvers", "case.toml"}, scratch.path);
  ASSERT_EQ(printed.exit_code, 0) << printed.output;
  for (const char* name : {"active-set", "projected", "tao", "mprgp"}) EXPECT_THAT(printed.output, HasSubstr(name));
  EXPECT_THAT(printed.output, Not(HasSubstr("does not hold")));
  const Outcome written = plastron({"compare", "--solvers", "case.toml", "--output", "out"}, scratch.path);
  ASSERT_EQ(written.exit_code, 0) << written.output;
  EXPECT_THAT(files_below(scratch.path / "out"), Contains("compare-solvers.json"));
  EXPECT_EQ(plastron({"compare", "case.toml"}, scratch.path).exit_code,
            2);  // formulations need a place for their files
}

TEST(GoodCase, may_have_triangles) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(2, "cells = \"triangle\"\n"));
  const Outcome outcome = plastron({"run", "case.toml", "--output", "out"}, scratch.path);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, Not(HasSubstr("lock")));
  const auto results = results_in(scratch.path / "out");
  EXPECT_EQ(results.at("levels").at(2).at("cells"), 4 * 8 * 16);
  EXPECT_EQ(results.at("settings").at("mesh").at("cells"), "triangle");
  EXPECT_EQ(results.at("settings").at("mesh").at("tying"), false);
  EXPECT_GT(results.at("contact").at("nodes"), 0);
}

TEST(GoodCase, is_warned_once_when_its_elements_lock) {
  const Scratch scratch;
  scratch.write("case.toml", strip + "[mesh]\ndegree = 1\nrefinements = 0\ncells = \"triangle\"\n");
  const Outcome outcome = plastron({"run", "case.toml", "--output", "out"}, scratch.path);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto first = outcome.output.find("warning: triangles of degree 1 without tying are likely to lock");
  EXPECT_NE(first, std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("likely to lock", first + 80), std::string::npos) << outcome.output;
}

TEST(GoodCase, prints_nothing_when_quiet) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(0));
  // A small load: the linear model is valid, and there are no warnings.
  const Outcome outcome =
      plastron({"run", "case.toml", "-o", "out", "-q", "--set", "load[0].force=[0,0,-1e-4]"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "");
}

TEST(GoodCase, may_be_run_again_into_the_same_directory_and_a_new_one_deep_down) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(0));
  for (const std::string output : {"out", "out", "a/b/c"}) {
    EXPECT_EQ(plastron({"run", "case.toml", "-o", output, "-q"}, scratch.path).exit_code, 0);
    EXPECT_TRUE(fs::exists(scratch.path / output / "results.json"));
  }
}

// ---- outputs that cannot be written --------------------------------------------------------------------------------

TEST(Output, that_is_a_file_is_bad_input_and_leaves_the_file_alone) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(0));
  scratch.write("out", "precious");
  for (const std::string output : {"out", "out/below"}) {
    const Outcome outcome = plastron({"run", "case.toml", "-o", output}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("cannot be written"));
  }
  EXPECT_EQ(text_of(scratch.path / "out"), "precious");
}

// ---- studies -------------------------------------------------------------------------------------------------------

TEST(Study, prints_its_table_and_writes_it_with_a_plot) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(1));
  const Outcome outcome =
      plastron({"study", "convergence", "case.toml", "--output", "out", "--reference", "1"}, scratch.path);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("Pressed strip"), HasSubstr("energy rate"), HasSubstr("with obstacle")));
  EXPECT_THAT(files_below(scratch.path / "out"), testing::UnorderedElementsAre("convergence.json", "convergence.svg"));
  const auto json = nlohmann::json::parse(text_of(scratch.path / "out/convergence.json"));
  EXPECT_EQ(json.at("status"), "solved");
  EXPECT_EQ(json.at("rows").size(), 4u);
  EXPECT_THAT(text_of(scratch.path / "out/convergence.svg"), HasSubstr("</svg>"));
}

TEST(Study, of_thickness_and_continuity_takes_its_options) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(0));
  const Outcome thin = plastron({"study", "thickness", "case.toml", "-o", "out", "-q", "--steps", "1"}, scratch.path);
  EXPECT_EQ(thin.exit_code, 0) << thin.output;
  EXPECT_EQ(thin.output, "");
  const Outcome thick =
      plastron({"study", "thickness", "case.toml", "-o", "out2", "-q", "--factors", "0.8,0.4"}, scratch.path);
  EXPECT_EQ(thick.exit_code, 0) << thick.output;
  const Outcome near = plastron({"study", "continuity", "case.toml", "-o", "out", "--samples", "1"}, scratch.path);
  EXPECT_EQ(near.exit_code, 0) << near.output;
  EXPECT_THAT(near.output, testing::Not(HasSubstr("does not hold")));
}

TEST(Study, that_is_asked_for_wrongly_is_bad_input) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", case_with(0)).string();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"study", "wisdom", file, "-o", "X"},
        {"study", "convergence", file},
        {"study", "convergence", "no-such.toml", "-o", "X"},
        {"study", "convergence", file, "-o", "X", "--reference", "0"},
        {"study", "thickness", file, "-o", "X", "--factors", "0.5,1"},
        {"study", "thickness", file, "-o", "X", "--factors", "1,-1"},
        {"study", "thickness", file, "-o", "X", "--factors", "1", "--steps", "2"},
        {"study", "continuity", file, "-o", "X", "--samples", "0"},
        {"study"}}) {
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments) << outcome.output;
  }
  EXPECT_THAT(plastron({"study", "wisdom", file, "-o", "X"}, scratch.path).output, HasSubstr("convergence"));
  EXPECT_FALSE(fs::exists(scratch.path / "X"));
}

TEST(Study, is_told_which_studies_take_an_option_that_is_foreign_to_it) {
  const Scratch scratch;
  const std::string file = scratch.write("case.toml", case_with(0)).string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> foreign{
      {{"study", "convergence", file, "-o", "X", "--samples", "3"}, "continuity"},
      {{"study", "continuity", file, "-o", "X", "--reference", "1"}, "convergence"},
      {{"study", "soft-modes", file, "-o", "X", "--factors", "1,0.5"}, "thickness, stability"},
      {{"study", "stability", file, "-o", "X", "--steps", "2"}, "thickness"},
      {{"study", "penalty", file, "-o", "X", "--seed", "2"}, "continuity"}};
  for (const auto& [arguments, takers] : foreign) {
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments) << outcome.output;
    EXPECT_THAT(outcome.output, AllOf(HasSubstr(arguments[5]), HasSubstr("does not take it"), HasSubstr(takers)));
  }
  EXPECT_FALSE(fs::exists(scratch.path / "X"));
}

TEST(Study, stops_where_a_formulation_that_it_computes_is_refused) {
  const Scratch scratch;
  std::string file = case_with(0);
  for (std::size_t at; (at = file.find(", \"r\"")) != std::string::npos;) file.erase(at, 5);
  for (std::size_t at; (at = file.find(", \"r.y\"")) != std::string::npos;) file.erase(at, 7);
  scratch.write("case.toml", file);
  const Outcome outcome = plastron({"study", "penalty", "case.toml", "-o", "X"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("penalised formulation"), HasSubstr("sees only the gradient")));
  EXPECT_FALSE(fs::exists(scratch.path / "X"));
}

TEST(Study, that_does_not_converge_says_so) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(1, "[solver]\nmax_iterations = 1\n"));
  const Outcome outcome = plastron({"study", "continuity", "case.toml", "-o", "out"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("not converged"));
  const auto json = nlohmann::json::parse(text_of(scratch.path / "out/continuity.json"));
  EXPECT_EQ(json.at("status"), "iteration_limit");
}

// ---- runs without a solution ---------------------------------------------------------------------------------------

TEST(Run, that_does_not_converge_says_so_in_its_exit_code_its_words_and_its_results) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(1, "[solver]\nmax_iterations = 1\n"));
  const Outcome outcome = plastron({"run", "case.toml", "-o", "out"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("not converged"));
  EXPECT_EQ(results_in(scratch.path / "out").at("status"), "iteration_limit");
}

/// Kills a run when `ready` or after a few seconds. Returns whether it was still running.
template <class Ready>
bool kill_when(Running& run, const Ready& ready) {
  for (int i = 0; i < 2000 && run.is_alive() && !ready(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const bool alive = run.is_alive();
  run.kill();
  return alive;
}

TEST(Run, that_is_killed_while_it_solves_leaves_no_results) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(5));
  Running run({"run", "case.toml", "-o", "out"}, scratch.path);
  // After two meshes it has tried the output directory, and the finest meshes are still to be solved.
  EXPECT_TRUE(kill_when(run, [&] { return run.output().find("\n    1 ") != std::string::npos; }));
  EXPECT_THAT(files_below(scratch.path), ElementsAre("case.toml"));
}

TEST(Run, that_would_replace_its_own_case_or_a_directory_is_refused_before_it_solves) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(0));
  ASSERT_EQ(plastron({"run", "case.toml", "-q", "-o", "out"}, scratch.path).exit_code, 0);
  const std::string copy = text_of(scratch.path / "out/solution.case.toml");
  const auto refused = [&](const std::string& file, const std::string& directory, const std::string& words) {
    const Outcome outcome = plastron({"run", file, "-o", directory}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, AllOf(HasSubstr(words), Not(HasSubstr("unknowns"))));
  };
  refused("out/solution.case.toml", "out", "the case is read from \"out/solution.case.toml\"");
  EXPECT_EQ(text_of(scratch.path / "out/solution.case.toml"), copy);
  fs::create_directories(scratch.path / "taken/results.json");
  refused("case.toml", "taken", "results.json\" is a directory");
  EXPECT_EQ(plastron({"run", "out/solution.case.toml", "-q", "-o", "again"}, scratch.path).exit_code, 0);
}

TEST(Run, that_is_killed_while_it_writes_leaves_whole_files_only) {
  const Scratch scratch;
  scratch.write("case.toml", case_with(4));
  Running run({"run", "case.toml", "-o", "out"}, scratch.path);
  kill_when(run, [&] { return !files_below(scratch.path / "out").empty(); });
  auto files = files_below(scratch.path / "out");
  std::erase_if(files, [](const std::string& f) { return f.starts_with(".plastron-partial-"); });
  for (const std::string& f : with_extension(files, ".vtu"))
    EXPECT_THAT(text_of(scratch.path / "out" / f), HasSubstr("</VTKFile>")) << f;
  for (const std::string& f : with_extension(files, ".pvd"))
    EXPECT_THAT(text_of(scratch.path / "out" / f), HasSubstr("</VTKFile>")) << f;
  if (fs::exists(scratch.path / "out/results.json")) {
    EXPECT_NO_THROW(results_in(scratch.path / "out"));
  }
}

}  // namespace
}  // namespace plastron::cli
