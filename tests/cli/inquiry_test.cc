// The commands without computation: explain, new, schema, completion, man. They answer at once and leave existing files alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string answer(const std::vector<std::string>& arguments) {
  const Scratch scratch;
  const Outcome outcome = plastron(arguments, scratch.path);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return outcome.output;
}

std::size_t longest_line(const std::string& text) {
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    longest = std::max(longest, end - begin);
    begin = end + 1;
  }
  return longest;
}

/// The words of a text, without punctuation.
std::string words_of(const std::string& text) {
  std::istringstream all(text);
  std::string words;
  for (std::string word; all >> word;) words += word + " ";
  return words;
}

TEST(Explain, answers_what_cannot_be_computed_as_the_page_of_limits_does) {
  std::ifstream page(std::filesystem::path(PLASTRON_SOURCE_DIR) / "docs/limits.md");
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line.starts_with("| word")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line.substr(2, line.size() - 4));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(words_of(cell));
    ASSERT_EQ(cells.size(), 4u) << line;
    const std::string text = words_of(answer({"explain", cells[0].substr(0, cells[0].size() - 1)}));
    for (const std::string& cell : cells) EXPECT_THAT(text, HasSubstr(cell.substr(0, cell.size() - 1)));
    ++rows;
  }
  EXPECT_GE(rows, 10);
  EXPECT_THAT(answer({"explain", "buckling"}), HasSubstr("limit of the program"));
  EXPECT_THAT(answer({"explain", "yield"}), HasSubstr("plasticity"));
  for (const char* word : {"point-load", "point_load"})
    EXPECT_THAT(answer({"explain", word}), HasSubstr("point-loads"));
}

// ---- explain ---------------------------------------------------------------------------------------------------

TEST(Explain, TellsOfAKeyOfTheCaseFile) {
  EXPECT_THAT(answer({"explain", "shell.thickness"}),
              AllOf(HasSubstr("shell.thickness: key of the case file"), HasSubstr("a number or an expression of x, y"),
                    HasSubstr("thickness > 0"), HasSubstr("required")));
  EXPECT_THAT(answer({"explain", "obstacle.ball"}),
              AllOf(HasSubstr("obstacle.ball: section"), HasSubstr("radius"), HasSubstr("inside")));
  EXPECT_THAT(answer({"explain", "mesh"}), AllOf(HasSubstr("mesh: section"), HasSubstr("default 3")));
}

TEST(Explain, TakesKeysAsMessagesAndSettingsHaveThem) {
  const std::string text = answer({"explain", "obstacle.force"});
  EXPECT_THAT(text, HasSubstr("presses the obstacle"));
  EXPECT_EQ(answer({"explain", "[[obstacle]].force"}), text);
  EXPECT_EQ(answer({"explain", "obstacle[0].force"}), text);
}

TEST(Explain, TellsOfFieldsNumbersAndStatuses) {
  EXPECT_THAT(answer({"explain", "eta"}), AllOf(HasSubstr("eta: field of the results"), HasSubstr("Pa"),
                                                HasSubstr("probes.NAME.eta in results.json")));
  EXPECT_THAT(answer({"explain", "displacement"}), HasSubstr("u: field"));
  EXPECT_THAT(answer({"explain", "contact.area"}), AllOf(HasSubstr("number of results.json"), HasSubstr("m^2")));
  EXPECT_THAT(answer({"explain", "obstacles.zones.peak.pressure"}), HasSubstr("obstacles[].zones[].peak.pressure"));
  EXPECT_THAT(answer({"explain", "certificate"}), HasSubstr("stationarity"));
  EXPECT_THAT(answer({"explain", "not_held"}), AllOf(HasSubstr("status"), HasSubstr("Contact alone would hold")));
  EXPECT_THAT(answer({"explain", "inaccurate"}), HasSubstr("exit code 3"));
}

TEST(Explain, TellsAllThatAWordMeans) {
  EXPECT_THAT(answer({"explain", "thickness"}), AllOf(HasSubstr("thickness: field"), HasSubstr("shell.thickness: key"),
                                                      HasSubstr("region.thickness: key")));
  EXPECT_THAT(answer({"explain", "by-cell"}), HasSubstr("output.resultants: key"));
}

TEST(Explain, WithoutAWordTellsWhatThereIs) {
  EXPECT_THAT(answer({"explain"}), AllOf(HasSubstr("obstacle.ball"), HasSubstr("frame.a3"),
                                         HasSubstr("obstacles[].zones[]"), HasSubstr("linear_solver_stalled")));
}

TEST(Explain, OfAnUnknownWordNamesNearOnes) {
  const Scratch scratch;
  const Outcome outcome = plastron({"explain", "shell.thicknes"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("did you mean"), HasSubstr("shell.thickness")));
  EXPECT_THAT(plastron({"explain", "qqqqqq"}, scratch.path).output,
              AllOf(Not(HasSubstr("did you mean")), HasSubstr("plastron explain lists")));
}

// ---- new -------------------------------------------------------------------------------------------------------

/// The names below a heading of `new --list`: "templates" or "gallery".
std::vector<std::string> listed(const std::string& collection) {
  std::vector<std::string> names;
  std::istringstream lines(answer({"new", "--list"}));
  bool is_below = false;
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with("  "))
      is_below = line == collection + ":";
    else if (is_below && line[2] != ' ')  // not the rest of a summary
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

TEST(New, HasTemplatesAndTheCasesOfTheGallery) {
  EXPECT_THAT(listed("templates"), ElementsAre("bowl", "dome", "mesh", "plate", "rollers", "tube"));
  std::vector<std::string> cases;
  for (const auto& folder : fs::directory_iterator(fs::path(PLASTRON_SOURCE_DIR) / "cases"))
    cases.push_back(folder.path().filename().string());
  EXPECT_THAT(listed("gallery"), testing::UnorderedElementsAreArray(cases));
  EXPECT_THAT(answer({"new", "--list"}), AllOf(HasSubstr("\n  bowl                  A spherical bowl"),
                                               HasSubstr("\n  bumper-on-stone       A bumper against a stone\n")));
}

TEST(New, WritesADirectoryOrAFile) {
  const Scratch scratch;
  EXPECT_EQ(plastron({"new", "deep/inside"}, scratch.path).exit_code, 0);
  EXPECT_EQ(plastron({"new", "mine.toml", "--from", "plate"}, scratch.path).exit_code, 0);
  EXPECT_EQ(plastron({"new", "holes", "-t", "mesh"}, scratch.path).exit_code, 0);
  EXPECT_THAT(files_below(scratch.path), testing::UnorderedElementsAre("deep/inside/case.toml", "mine.toml",
                                                                       "holes/case.toml", "holes/plate-with-hole.msh"));
  EXPECT_THAT(text_of(scratch.path / "mine.toml"), HasSubstr("clamped"));
}

/// All files of all cases, byte for byte; README.md is about the case and stays in the gallery.
TEST(New, CopiesACaseOfTheGalleryWithItsFiles) {
  const fs::path cases = fs::path(PLASTRON_SOURCE_DIR) / "cases";
  for (const std::string& name : listed("gallery")) {
    const Scratch scratch;
    EXPECT_EQ(plastron({"new", "mine", "--from", name}, scratch.path).exit_code, 0) << name;
    std::vector<std::string> originals;
    for (const auto& file : fs::directory_iterator(cases / name))
      if (file.path().filename() != "README.md") originals.push_back(file.path().filename().string());
    std::vector<std::string> expected;
    for (const std::string& file : originals) {
      expected.push_back("mine/" + file);
      EXPECT_EQ(text_of(scratch.path / "mine" / file), text_of(cases / name / file)) << name;
    }
    EXPECT_THAT(files_below(scratch.path), testing::UnorderedElementsAreArray(expected)) << name;
  }
  const Scratch scratch;
  EXPECT_EQ(plastron({"new", "mine.toml", "--from", "bumper-on-stone"}, scratch.path).exit_code, 0);
  const Outcome check = plastron({"check", "mine.toml"}, scratch.path);
  EXPECT_EQ(check.exit_code, 0) << check.output;
}

TEST(New, TakesTheFormerNameOfFromButNotBoth) {
  const Scratch scratch;
  EXPECT_EQ(plastron({"new", "mine", "--template", "tank-in-cradle"}, scratch.path).exit_code, 0);
  EXPECT_TRUE(fs::exists(scratch.path / "mine/tank.msh"));
  const Outcome outcome = plastron({"new", "other", "-t", "bowl", "--from", "tube"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_FALSE(fs::exists(scratch.path / "other"));
  EXPECT_THAT(answer({"new", "--help"}), AllOf(HasSubstr("--from"), Not(HasSubstr("--template"))));
  EXPECT_THAT(answer({"man"}), AllOf(HasSubstr("\\-\\-from"), Not(HasSubstr("\\-\\-template"))));
}

TEST(New, OverwritesNothing) {
  const Scratch scratch;
  scratch.write("case.toml", "mine");
  fs::create_directory(scratch.path / "empty");
  scratch.write("plate-with-hole.msh", "mine");
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"new", "case.toml"}, {"new", "empty"}, {"new", "other.toml", "-t", "mesh"}, {"new", "case.toml/below"}}) {
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << arguments[1];
    EXPECT_THAT(outcome.output, HasSubstr("error: "));
  }
  EXPECT_EQ(text_of(scratch.path / "case.toml"), "mine");
  EXPECT_EQ(text_of(scratch.path / "plate-with-hole.msh"), "mine");
  EXPECT_FALSE(fs::exists(scratch.path / "other.toml"));
}

TEST(New, RefusesAnUnknownExampleAndNoName) {
  const Scratch scratch;
  const Outcome outcome = plastron({"new", "mine", "--from", "bowle"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("did you mean \"bowl\"?"), HasSubstr("rollers"), HasSubstr("wavy-floor")));
  EXPECT_EQ(plastron({"new"}, scratch.path).exit_code, 2);
  EXPECT_THAT(files_below(scratch.path), IsEmpty());
}

TEST(New, WritesCasesThatRunAsTheyAre) {
  for (const std::string& name : listed("templates")) {
    const Scratch scratch;
    EXPECT_EQ(plastron({"new", "begun", "--from", name}, scratch.path).exit_code, 0) << name;
    const Outcome check = plastron({"check", "begun/case.toml"}, scratch.path);
    EXPECT_EQ(check.exit_code, 0) << name << check.output;
    EXPECT_THAT(check.output, Not(HasSubstr("warning"))) << name;
    const Outcome run = plastron({"run", "begun/case.toml", "--output", "out"}, scratch.path, 300);
    EXPECT_EQ(run.exit_code, 0) << name << run.output;
    const auto results = nlohmann::json::parse(text_of(scratch.path / "out/results.json"));
    for (const std::string warning : results["warnings"])  // pictures of contact need visible displacements
      EXPECT_THAT(warning, AnyOf(HasSubstr("linear"), HasSubstr("strain"), HasSubstr("along lines"))) << name;
    EXPECT_EQ(results["status"], "solved") << name;
    if (name != "plate") {
      EXPECT_GT(results["contact"]["nodes"], 0) << name;
    }
  }
}

// ---- schema, completion, man -----------------------------------------------------------------------------------

TEST(Schema, IsJsonOfTheCaseFileOrOfTheResults) {
  const auto of_case = nlohmann::json::parse(answer({"schema"})),
             of_results = nlohmann::json::parse(answer({"schema", "results"}));
  EXPECT_TRUE(of_case["definitions"]["obstacle.ball"]["properties"].contains("radius"));
  EXPECT_TRUE(of_results["properties"]["obstacles"]["items"]["properties"].contains("zones"));
  EXPECT_THAT(of_results["properties"]["status"]["enum"], Contains("not_carried"));
}

/// The words that bash offers after these; the last one is incomplete.
std::vector<std::string> offered(const Scratch& scratch, const std::string& words) {
  const std::string script = "source <($PLASTRON completion bash); COMP_WORDS=(plastron " + words +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _plastron; printf '%s\\n' \"${COMPREPLY[@]}\"";
  scratch.write("complete.bash", script);
  const Outcome outcome = shell("bash complete.bash", scratch.path);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  std::vector<std::string> all;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) all.push_back(line);
  std::ranges::sort(all);
  return all;
}

TEST(BashCompletion, OffersCommandsOptionsAndWords) {
  const Scratch scratch;
  EXPECT_THAT(offered(scratch, "''"),
              AllOf(Contains("run"), Contains("explain"), Contains("study"), Contains("--help")));
  EXPECT_THAT(offered(scratch, "ver"), ElementsAre("verify"));
  EXPECT_THAT(offered(scratch, "run --o"), ElementsAre("--out", "--output"));
  EXPECT_THAT(offered(scratch, "study con"), ElementsAre("continuity", "convergence"));
  EXPECT_THAT(offered(scratch, "new x --from ro"), ElementsAre("rollers"));
  EXPECT_THAT(offered(scratch, "new x --from tank"), ElementsAre("tank-in-cradle"));
  EXPECT_THAT(offered(scratch, "new x --t"), IsEmpty());
  EXPECT_THAT(offered(scratch, "explain shell.thick"), ElementsAre("shell.thickness"));
  EXPECT_THAT(offered(scratch, "run --set mesh.ref"), ElementsAre("mesh.refinements="));
}

TEST(BashCompletion, OffersCaseFilesWhereACaseIsWanted) {
  const Scratch scratch;
  scratch.write("a.toml", "");
  scratch.write("notes.txt", "");
  fs::create_directory(scratch.path / "cases");
  EXPECT_THAT(offered(scratch, "run ''"), ElementsAre("a.toml", "cases"));
  EXPECT_THAT(offered(scratch, "run --output ''"), ElementsAre("cases"));
  EXPECT_THAT(offered(scratch, "run --output cases ''"), ElementsAre("a.toml", "cases"));
  EXPECT_THAT(offered(scratch, "study penalty ''"), ElementsAre("a.toml", "cases"));
  EXPECT_THAT(offered(scratch, "run a.toml ''"), IsEmpty());
}

TEST(BashCompletion, OffersMeshesWhereAMeshIsWanted) {
  const Scratch scratch;
  for (const char* name : {"a.msh", "b.inp", "c.toml", "d.html", "e.stl", "f.obj", "g.ply"}) scratch.write(name, "");
  EXPECT_THAT(offered(scratch, "parts ''"), ElementsAre("a.msh", "b.inp", "e.stl", "f.obj", "g.ply"));
  EXPECT_THAT(offered(scratch, "parts a.msh --page ''"), ElementsAre("d.html"));
}

TEST(Completions, OfOtherShellsHaveEveryCommand) {
  for (const char* shell : {"zsh", "fish"}) {
    const std::string text = answer({"completion", shell});
    for (const char* command : {"run", "check", "compare", "verify", "study", "explain", "new", "schema", "completion"})
      EXPECT_THAT(text, HasSubstr(command)) << shell;
  }
}

TEST(ManualPage, HasEveryCommandOptionAndStatus) {
  const std::string page = answer({"man"});
  EXPECT_TRUE(page.starts_with(".TH PLASTRON 1"));
  for (const char* part : {".SS \"study\"", "\\-\\-json\\-log", "\\-\\-set", "not_carried", ".SH EXIT STATUS"})
    EXPECT_THAT(page, HasSubstr(part));
}

// ---- all of them -----------------------------------------------------------------------------------------------

const std::vector<std::vector<std::string>> inquiries{{"--help"},
                                                      {"--version"},
                                                      {"explain"},
                                                      {"explain", "eta"},
                                                      {"explain", "mesh"},
                                                      {"schema"},
                                                      {"new", "--list"},
                                                      {"run", "--help"},
                                                      {"study", "--help"},
                                                      {"completion", "bash"},
                                                      {"study", "nothing"},
                                                      {"run"},
                                                      {"explain", "nothing"},
                                                      {"check", "no.toml"},
                                                      {"new", "--nothing"}};

/// The best of a few tries, because other programs run beside the test.
TEST(Inquiries, AreAnsweredAtOnce) {
  const Scratch scratch;
  for (const auto& arguments : inquiries) {
    double best = 60;
    for (int attempt = 0; attempt < 20 && best > 0.2; ++attempt)
      best = std::min(best, plastron(arguments, scratch.path).seconds);
    EXPECT_LT(best, 0.2) << arguments[0] << " " << arguments.back();
  }
}

TEST(Inquiries, PrintLinesOf120CharactersAtMost) {
  const Scratch scratch;
  for (const auto& arguments : inquiries)
    if (arguments[0] != "schema" && arguments[0] != "completion") {
      EXPECT_LE(longest_line(plastron(arguments, scratch.path).output), 120u)
          << arguments[0] << " " << arguments.back();
    }
}

TEST(UnknownCommands, AreAnsweredWithTheNearest) {
  const Scratch scratch;
  const Outcome outcome = plastron({"verfy"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("did you mean \"verify\"?"), HasSubstr("completion")));
}

}  // namespace
}  // namespace plastron::cli
