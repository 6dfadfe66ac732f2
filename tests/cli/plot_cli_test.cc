// plastron plot: pictures from results alone, made by the program without a solver.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

const std::string plate = R"(title = "Plate over a floor that rises"
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { rectangle = { to = [1, 1], cells = [2, 2] } }
chart = ["x", "y", "0.035"]
[[support]]
boundary = "left"
fix = ["u", "r"]
[[load]]
force = [0, 0, -4e-4]
[[obstacle]]
name = "floor-1"
half_space = { point = [0, 0, 0], normal = [0, 0, 1] }
[[line]]
name = "across"
through = [[0, 0.5], [1, 0.5]]
points = 5
)";
const std::string steps =
    "[[step]]\nname = \"down\"\nparts = 2\n[[step.move]]\nobstacle = \"floor-1\"\ntranslate = [0, 0, 0.002]\n";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

TEST(PlotCommand, DrawsMeshesLinesAndStepsFromTheResultsAlone) {
  const Scratch scratch;
  scratch.write("case.toml", plate + "[mesh]\nrefinements = 2\n" + steps);
  const Outcome run = plastron({"run", "case.toml", "-q", "--no-report", "-o", "ran"}, scratch.path);
  ASSERT_EQ(run.exit_code, 0) << run.output;
  fs::create_directory(scratch.path / "out");
  for (const char* name : {"results.json", "line-across.csv"})
    fs::rename(scratch.path / "ran" / name, scratch.path / "out" / name);
  const Outcome plot = plastron({"plot", "out"}, scratch.path);
  ASSERT_EQ(plot.exit_code, 0) << plot.output;
  const auto written = lines_of(plot.output);
  EXPECT_THAT(written, IsSupersetOf({"out/plot-energy.svg", "out/plot-reaction.svg", "out/plot-contact-area.svg",
                                     "out/plot-touching-nodes.svg", "out/plot-history-obstacles.svg",
                                     "out/plot-history-supports.svg", "out/plot-line-across-displacement.svg",
                                     "out/plot-line-across-von-mises.svg"}));
  EXPECT_EQ(files_below(scratch.path / "out").size(), written.size() + 2);
  for (const std::string& file : written)
    EXPECT_THAT(text_of(scratch.path / file),
                AllOf(StartsWith("<svg "), HasSubstr("class=\"mark"), Not(HasSubstr("nan"))))
        << file;
  EXPECT_THAT(text_of(scratch.path / "out/plot-history-obstacles.svg"), HasSubstr("floor-1"));
  EXPECT_THAT(text_of(scratch.path / "out/plot-line-across-moments.svg"),
              AllOf(HasSubstr("bending moments [N]"), HasSubstr("length [m]"), HasSubstr("M_12")));
}

TEST(PlotCommand, FollowsNoLinkAndWaitsForNoPipe) {
  const Scratch scratch;
  fs::create_directory(scratch.path / "out");
  const std::string level = R"({"unknowns": 5, "energy": 1.5, "active": 0},{"unknowns": 9, "energy": 2, "active": 0})";
  scratch.write("out/results.json", R"({"levels": [)" + level + R"(], "history": [], "contact": null, "files": []})");
  const fs::path precious = scratch.write("precious", "precious");
  for (const char* name : {"plot-energy.svg", "plot-energy.svg.partial"})
    fs::create_symlink(precious, scratch.path / "out" / name);
  EXPECT_EQ(plastron({"plot", "out"}, scratch.path).exit_code, 0);
  EXPECT_EQ(text_of(precious), "precious");
  EXPECT_THAT(text_of(scratch.path / "out/plot-energy.svg"), StartsWith("<svg "));
  EXPECT_EQ(files_below(scratch.path / "out").size(), 3U);
  fs::remove(scratch.path / "out/results.json");
  ASSERT_EQ(mkfifo((scratch.path / "out/results.json").c_str(), 0600), 0);
  const Outcome outcome = plastron({"plot", "out"}, scratch.path, 10);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("cannot be read"));
}

TEST(PlotCommand, ReadsManyMeshesWithoutAllThatIsSaidOfThem) {
  const Scratch scratch;
  std::string levels;
  for (int k = 1; k <= 100000; ++k)
    levels +=
        std::string(k > 1 ? "," : "") + R"({"unknowns": )" + std::to_string(k) +
        R"(, "energy": 1.5, "active": 0, "history": [)" +
        R"({"a": 1, "b": 2, "c": 3, "d": 4, "e": 5, "f": 6, "g": 7, "h": 8, "i": 9, "j": 10, "k": 11, "l": 12}]})";
  scratch.write("results.json", R"({"levels": [)" + levels + R"(], "history": [], "contact": null, "files": []})");
  const Outcome outcome = shell("ulimit -v 600000; $PLASTRON plot .", scratch.path);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_LT(fs::file_size(scratch.path / "plot-energy.svg"), 4000000U);
#endif
}

TEST(PlotCommand, RefusesWhatIsNoResult) {
  const Scratch scratch;
  const auto refused = [&](const std::string& directory, const std::string& word) {
    const Outcome outcome = plastron({"plot", directory}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, AllOf(StartsWith("error: "), HasSubstr(word)));
  };
  refused("nowhere", "not a directory");
  refused(".", "no results.json");
  const auto results = scratch.write("results.json", "{\"levels\": [");
  refused(".", "does not have the form");
  scratch.write("results.json", "{\"levels\": [], \"history\": []}");
  refused(".", "key 'contact'");
  scratch.write("results.json", R"({"levels": [], "history": [], "contact": null, "files": []})");
  refused(".", "nothing to plot");
  scratch.write("results.json", R"({"levels": [], "history": [], "contact": null, "files": ["line-a.csv"]})");
  refused(".", "line-a.csv cannot be read");
  scratch.write("line-a.csv", "s [m],N_11 [N/m]\n0,1\n1,one\n");
  refused(".", "line 3: \"one\" is not a number");
  scratch.write("line-a.csv", "s [m],N_11 [N/m]\n0,1,2\n");
  refused(".", "3 columns, where the first line has 2");
  EXPECT_EQ(plastron({"plot"}, scratch.path).exit_code, 2);
}

}  // namespace
}  // namespace plastron::cli
