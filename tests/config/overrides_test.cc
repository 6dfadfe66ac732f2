// --set: its effect on the text, and the place that messages about mistakes name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>
#include <plastron/config/overrides.hpp>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace plastron::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string disk = R"(# A pressed disk
[shell]            # the material
E = 1.0
nu = 0.3
thickness = "0.1/2" # comment
[geometry]
domain = { disk = { radius = 1 } }
chart = ["x",
         "y", # over lines
         "0.1"]
[[load]]
force = [0, 0, -1e-3]
[[obstacle]]
half_space = {}
[[obstacle]]
name = "ball"
ball = { centre = [0, 0, 5], radius = 1 }
)";

std::string edited(const std::string& text, const std::vector<std::string>& settings) {
  return Overrides(text, "case.toml", settings).text();
}

/// The text without the comments at its top.
std::string body(const std::vector<std::string>& settings) {
  std::string text = edited(disk, settings);
  for (const std::string& setting : settings) {
    const std::string comment = "# --set " + setting + "\n";
    EXPECT_TRUE(text.starts_with(comment)) << text;
    text.erase(0, comment.size());
  }
  return text;
}

std::string with(std::string text, const std::string& old, const std::string& now) {
  EXPECT_NE(text.find(old), std::string::npos) << old;
  return text.replace(text.find(old), old.size(), now);
}

TEST(Overrides, WithoutSettingsLeaveTheTextAsItIs) { EXPECT_EQ(edited(disk, {}), disk); }

TEST(Overrides, ReplaceAValueWhereItStands) {
  EXPECT_EQ(body({"shell.thickness=0.02"}), with(disk, "\"0.1/2\"", "0.02"));
  EXPECT_EQ(body({"shell.E = 2e11"}), with(disk, "E = 1.0", "E =  2e11"));
  EXPECT_EQ(body({"geometry.domain.disk.radius=\"pi\""}), with(disk, "radius = 1 }", "radius = \"pi\" }"));
  EXPECT_EQ(body({"geometry.domain={disk={radius=3}}"}), with(disk, "{ disk = { radius = 1 } }", "{disk={radius=3}}"));
  EXPECT_EQ(body({"geometry.chart[2]='0.3'"}), with(disk, "\"0.1\"]", "'0.3']"));
  EXPECT_EQ(body({"obstacle[1].ball.centre=[0,0,6]"}), with(disk, "[0, 0, 5]", "[0,0,6]"));
  EXPECT_EQ(body({"load[0].force[2]=-1"}), with(disk, "-1e-3", "-1"));
}

TEST(Overrides, ReplaceAListOfSeveralLines) {
  EXPECT_EQ(body({"geometry.chart=[\"x\", \"y\", \"x*y\"]"}),
            with(disk, "[\"x\",\n         \"y\", # over lines\n         \"0.1\"]", "[\"x\", \"y\", \"x*y\"]"));
}

TEST(Overrides, AddWhatTheFileDoesNotGive) {
  EXPECT_EQ(body({"shell.density=7800"}), with(disk, "# the material\n", "# the material\ndensity = 7800\n"));
  EXPECT_EQ(body({"mesh.degree=3"}), disk + "\n[mesh]\ndegree = 3\n");
  EXPECT_EQ(body({"title=\"new\""}), "title = \"new\"\n" + disk);
  EXPECT_EQ(body({"obstacle[0].force=[0,0,-2]"}), with(disk, "[[obstacle]]\n", "[[obstacle]]\nforce = [0,0,-2]\n"));
  EXPECT_EQ(body({"obstacle[0].half_space.point=[0,0,1]"}), with(disk, "{}", "{ point = [0,0,1] }"));
  EXPECT_EQ(body({"obstacle[1].ball.inside=true"}), with(disk, "{ centre", "{ inside = true, centre"));
}

TEST(Overrides, OfOneSectionGoThere) {
  const std::string text = body({"mesh.degree=3", "mesh.refinements=1"});
  EXPECT_EQ(text, disk + "\n[mesh]\nrefinements = 1\ndegree = 3\n");
  EXPECT_EQ(body({"mesh.degree=3", "mesh.degree=12"}), disk + "\n[mesh]\ndegree = 12\n") << "the last one counts";
}

TEST(Overrides, ReachASectionThatOnlyItsPartsName) {
  const std::string text = "[geometry.domain.disk]\nradius = 1\n[shell]\nE = 1\n";
  const std::string expected = text + "\n[geometry]\nchart = [\"x\", \"y\", 0]\n";
  EXPECT_THAT(edited(text, std::vector<std::string>{"geometry.chart=[\"x\", \"y\", 0]"}), HasSubstr(expected));
}

TEST(Overrides, KeepTheLineBreaksOfTheFile) {
  const std::string text = edited("[shell]\r\nE = 1\r\n", std::vector<std::string>{"shell.nu=0.3"});
  EXPECT_THAT(text, HasSubstr("[shell]\nnu = 0.3\r\nE = 1\r\n"));
}

/// The message about a setting that is wrong by itself.
std::string refusal_of(const std::string& setting) {
  try {
    edited(disk, {setting});
  } catch (const CaseErrors& errors) {
    EXPECT_THAT(errors.format(), HasSubstr("--set " + setting + ": error: "));
    return errors.format();
  }
  ADD_FAILURE() << setting << " was accepted";
  return "";
}

TEST(Overrides, ThatAreWrongAreNamed) {
  EXPECT_THAT(refusal_of("shell.E"), HasSubstr("has no ="));
  EXPECT_THAT(refusal_of("=3"), HasSubstr("no key of a case file"));
  EXPECT_THAT(refusal_of("shell..E=3"), HasSubstr("no key of a case file"));
  EXPECT_THAT(refusal_of("[0]=3"), HasSubstr("no key of a case file"));
  EXPECT_THAT(refusal_of("obstacle[x].force=3"), HasSubstr("no key of a case file"));
  EXPECT_THAT(refusal_of("obstacle[0.force=3"), HasSubstr("no key of a case file"));
  EXPECT_THAT(refusal_of("mesh.cells=triangle"), HasSubstr("in quotes that the shell leaves"));
  EXPECT_THAT(refusal_of("shell.E="), HasSubstr("value is missing"));
  EXPECT_THAT(refusal_of("obstacle[2].force=[0,0,1]"), HasSubstr("obstacle has 2 entries, counted from 0"));
  EXPECT_THAT(refusal_of("obstacle.force=[0,0,1]"), HasSubstr("obstacle[0] is the first"));
  EXPECT_THAT(refusal_of("shell[0].E=1"), HasSubstr("shell is no list"));
  EXPECT_THAT(refusal_of("shell.E.x=1"), HasSubstr("shell.E has no keys"));
  EXPECT_THAT(refusal_of("shell={}"), HasSubstr("set its keys one by one"));
  EXPECT_THAT(refusal_of("obstacle=[]"), HasSubstr("set its keys one by one"));
  EXPECT_THAT(refusal_of("probe[0].at=[0,0]"), HasSubstr("the case has no probe"));
}

TEST(Overrides, WithAControlCharacterAreRefused) { EXPECT_THROW(edited(disk, {"shell.E=1\n[mesh]"}), CaseErrors); }

/// A case file in the temporary directory.
struct CaseFile {
  explicit CaseFile(const std::string& text) : path(std::filesystem::temp_directory_path() / name()) {
    std::ofstream(path) << text;
  }
  ~CaseFile() { std::filesystem::remove(path); }
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;
  static std::string name() { return "plastron-overrides-" + std::to_string(getpid()) + ".toml"; }
  std::filesystem::path path;
};

std::string read_refusal(const std::string& text, const std::vector<std::string>& settings) {
  const CaseFile file(text);
  try {
    read_case(file.path, settings);
  } catch (const CaseErrors& errors) {
    return errors.format();
  }
  ADD_FAILURE() << "was accepted";
  return "";
}

TEST(CasesWithSettings, AreThoseOfTheirText) {
  const CaseFile file(disk);
  const std::vector<std::string> settings{"shell.thickness=0.02", "mesh.refinements=1", "constants.R=3"};
  const Case c = read_case(file.path, settings), again = parse_case(c.text, "copy.toml");
  EXPECT_EQ(c.effective["shell"]["thickness"], 0.02);
  EXPECT_EQ(c.problem.discretisation.refinements, 1);
  EXPECT_EQ(c.effective["constants"]["R"], 3.0);
  EXPECT_EQ(again.effective, c.effective);
}

TEST(CasesWithSettings, TellOfTheSettingThatTheReaderRefuses) {
  const std::string text = read_refusal(disk, {"mesh.degree=2", "shell.thickness=-1", "shell.thicknes=1"});
  EXPECT_THAT(text,
              HasSubstr("--set shell.thickness=-1: error: thickness is -1, out of range\n   allowed: thickness > 0"));
  EXPECT_THAT(text, HasSubstr("--set shell.thicknes=1: error: unknown key \"thicknes\" in [shell]"));
  EXPECT_THAT(text, HasSubstr("did you mean \"thickness\"?"));
}

TEST(CasesWithSettings, TellOfTheFileAsItWasElsewhere) {
  const std::string wrong = with(disk, "force = [0, 0, -1e-3]", "forse = [0, 0, -1e-3]");
  const auto place = CaseFile::name() + ":12:1: error: unknown key \"forse\"";
  EXPECT_THAT(read_refusal(wrong, {}), HasSubstr(place));
  // Other lines are added and removed above it.
  EXPECT_THAT(read_refusal(wrong, {"title=\"a\"", "shell.shear_correction=1", "geometry.chart=[\"x\", \"y\", 0]"}),
              AllOf(HasSubstr(place), Not(HasSubstr("--set"))));
}

TEST(CasesWithSettings, OfAFileThatIsNoTomlTellOfTheFile) {
  EXPECT_THAT(read_refusal("[shell\nE = 1\n", {"shell.nu=0.3"}), AllOf(HasSubstr(":1:"), Not(HasSubstr("--set"))));
}

}  // namespace
}  // namespace plastron::config
