// A mesh in space from the command line: parts, check, run, verify; both formats of files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Floor and wall in a right angle; the wall's nodes run the other way round.
const std::string msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n3\n1 1 \"edge\"\n2 2 \"floor\"\n2 3 \"wall\"\n$EndPhysicalNames\n"
    "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 0 1 1\n$EndNodes\n"
    "$Elements\n3\n1 1 2 1 1 2 3\n2 3 2 2 1 1 2 3 4\n3 3 2 3 2 1 5 6 4\n$EndElements\n";
const std::string inp =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 0, 1, 1\n"
    "*ELEMENT, TYPE=S4R, ELSET=floor\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S4R, ELSET=wall\n2, 1, 5, 6, 4\n"
    "*NSET, NSET=edge\n2, 3\n";

std::string case_with(const std::string& file) {
  return "[geometry]\nfile = \"" + file +
         "\"\n[shell]\nE = 1e9\nnu = 0.3\nthickness = 0.02\n[[support]]\nboundary = \"edge\"\nfix = [\"u\", \"r\"]\n"
         "[[load]]\nregion = \"wall\"\nforce = [\"-100*Z\", 0, 0]\n[[probe]]\nname = \"top\"\nat = [0, 0.5, 1.01]\n"
         "[mesh]\ndegree = 3\nrefinements = 2\n";
}

double deflection(const Scratch& scratch, const std::string& name, const std::string& text) {
  std::ofstream(scratch.path / name) << text;
  std::ofstream(scratch.path / (name + ".toml")) << case_with(name);
  const Outcome run = plastron({"run", name + ".toml", "--output", name + "-out"}, scratch.path);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  const Outcome verify = plastron({"verify", name + "-out"}, scratch.path);
  EXPECT_THAT(verify.output, HasSubstr("PASSED"));
  const auto results = nlohmann::json::parse(text_of(scratch.path / (name + "-out") / "results.json"));
  return results["probes"]["top"]["u"][0];
}

TEST(MeshInSpace, GivesOneResultFromBothFormats) {
  const Scratch scratch;
  const double from_msh = deflection(scratch, "angle.msh", msh);
  EXPECT_NEAR(deflection(scratch, "angle.inp", inp), from_msh, 1e-10 * std::abs(from_msh));
  // The moment of the load at the fold, 100/3 for each metre, turns it by M L / (E e^3 / 12) and bends the wall: 1/3 ML + q L^4 (11/120).
  const double stiffness = 1e9 * 0.02 * 0.02 * 0.02 / 12;
  EXPECT_NEAR(from_msh, -(100.0 / 3 + 100 * 11.0 / 120) / stiffness, 0.1 * std::abs(from_msh));
}

/// The same angle as facets: two triangles a face, whose edges have numbers in the place of names.
TEST(MeshInSpace, CanBeFacets) {
  const Scratch scratch;
  fs::copy_file(fs::path(PLASTRON_SOURCE_DIR) / "tests/domain/data/angle.stl", scratch.path / "angle.stl");
  const Outcome parts = plastron({"parts", "angle.stl", "--size", "0.2"}, scratch.path);
  EXPECT_EQ(parts.exit_code, 0) << parts.output;
  EXPECT_THAT(parts.output,
              AllOf(HasSubstr("4 facets of 2 units^2"), HasSubstr("about 0.2 units (size)"), HasSubstr("floor"),
                    HasSubstr("wall"), HasSubstr("edge 7"), HasSubstr("4 folds (90 to 90 degrees)")));
  // The edge of the floor that the case holds has its middle at x = 1.
  const std::size_t line = parts.output.find("(1, 0, 0), (1, 1, 0)"), start = parts.output.rfind("edge ", line);
  ASSERT_NE(line, std::string::npos);
  std::string text = case_with("angle.stl");
  text.replace(text.find("\"edge\""), 6, "\"" + parts.output.substr(start, 6) + "\"");
  text.replace(text.find("refinements = 2"), 15, "refinements = 0");
  text.replace(text.find("[shell]"), 7, "size = 0.2\n[shell]");
  std::ofstream(scratch.path / "facets.toml") << text;
  const Outcome run = plastron({"run", "facets.toml", "--output", "out"}, scratch.path);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(plastron({"verify", "out"}, scratch.path).output, HasSubstr("PASSED"));
  const auto results = nlohmann::json::parse(text_of(scratch.path / "out" / "results.json"));
  const double from_msh = deflection(scratch, "angle.msh", msh), from_facets = results["probes"]["top"]["u"][0];
  EXPECT_NEAR(from_facets, from_msh, 0.01 * std::abs(from_msh));
}

/// A quarter of a tube. The nodes lie on the facets, so that nothing is known of the part.
TEST(MeshInSpace, OfCurvedFacetsHasNoEstimateOfItsError) {
  const Scratch scratch;
  {
    std::ofstream file(scratch.path / "tube.obj");
    constexpr int strips = 24;
    for (int i = 0; i <= strips; ++i) {
      const double angle = std::numbers::pi / 2 * i / strips;
      for (const int y : {0, 1}) file << "v " << std::cos(angle) << " " << y << " " << std::sin(angle) << "\n";
    }
    for (int i = 0; i < strips; ++i)
      file << "f " << 2 * i + 1 << " " << 2 * i + 2 << " " << 2 * i + 4 << " " << 2 * i + 3 << "\n";
  }
  std::ofstream(scratch.path / "tube.toml")
      << "[geometry]\nfile = \"tube.obj\"\nsize = 0.15\n[shell]\nE = 1e9\nnu = 0.3\nthickness = 0.02\n[[support]]\n"
         "boundary = \"edge 1\"\nfix = [\"u\", \"r\"]\n[[load]]\npressure = 1\n[mesh]\ndegree = 2\nrefinements = 0\n";
  const Outcome run = plastron({"run", "tube.toml", "--output", "out"}, scratch.path);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("by the facets, of the file is not estimated"));
  const auto results = nlohmann::json::parse(text_of(scratch.path / "out" / "results.json"));
  EXPECT_TRUE(results["estimates"]["geometry"]["deviation"].is_null());
  EXPECT_EQ(results["estimates"]["geometry"]["judged_share"], 0);
}

TEST(MeshInSpace, IsListedByItsParts) {
  const Scratch scratch;
  std::ofstream(scratch.path / "angle.msh") << msh;
  const Outcome parts = plastron({"parts", "angle.msh", "--scale", "1e-3"}, scratch.path);
  EXPECT_EQ(parts.exit_code, 0);
  EXPECT_THAT(parts.output, AllOf(HasSubstr("2 quadrilaterals of order 1"), HasSubstr("1 folds (90 to 90 degrees)"),
                                  HasSubstr("floor"), HasSubstr("wall"), HasSubstr("edge"), HasSubstr("1 turned")));
  const Outcome missing = plastron({"parts", "no.msh"}, scratch.path);
  EXPECT_EQ(missing.exit_code, 2);
}

TEST(MeshInSpace, IsAPageToTurnRound) {
  const Scratch scratch;
  std::ofstream(scratch.path / "angle.msh") << msh;
  std::ofstream(scratch.path / "page.html") << "an earlier page";
  const Outcome parts = plastron({"parts", "angle.msh", "--page", "page.html"}, scratch.path);
  EXPECT_EQ(parts.exit_code, 0) << parts.output;
  EXPECT_THAT(parts.output, AllOf(HasSubstr("fold 1"), HasSubstr("page.html")));
  EXPECT_THAT(files_below(scratch.path), testing::UnorderedElementsAre("angle.msh", "page.html"));
  const std::string page = text_of(scratch.path / "page.html");
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_THAT(page, AllOf(HasSubstr("<td class=\"word\">wall</td>"), HasSubstr("\"name\":\"edge\""),
                          HasSubstr("\"name\":\"fold 1\"")));
  EXPECT_EQ(page.find(" src=\"http"), std::string::npos);
}

TEST(MeshInSpace, IsNoPageWhereItCannotBeOne) {
  const Scratch scratch;
  std::ofstream(scratch.path / "angle.msh") << msh;
  std::ofstream(scratch.path / "flat.msh") << msh.substr(0, msh.find("$Elements"));
  std::ofstream(scratch.path / "kept.html") << "kept";
  fs::create_directory(scratch.path / "folder.html");
  fs::create_symlink("angle.msh", scratch.path / "mesh.html");
  const auto expect = [&](const std::string& mesh, const std::string& page, const std::string& message) {
    const Outcome outcome = plastron({"parts", mesh, "--page", page}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << mesh << " " << page;
    EXPECT_THAT(outcome.output, HasSubstr(message));
  };
  expect("angle.msh", "angle.msh", "must end in .html");
  expect("angle.msh", "mesh.html", "would replace the mesh");
  expect("angle.msh", "nowhere/page.html", "choose another place with --page");
  expect("angle.msh", "folder.html", "choose another place with --page");
  expect("flat.msh", "kept.html", "flat.msh");
  const Outcome full = shell("trap '' XFSZ; ulimit -f 300; $PLASTRON parts angle.msh --page kept.html", scratch.path);
  EXPECT_EQ(full.exit_code, 2) << full.output;
  EXPECT_EQ(text_of(scratch.path / "kept.html"), "kept");
  EXPECT_EQ(text_of(scratch.path / "angle.msh"), msh);
  fs::remove(scratch.path / "mesh.html");
  EXPECT_THAT(files_below(scratch.path), testing::UnorderedElementsAre("angle.msh", "flat.msh", "kept.html"));
}

TEST(MeshInSpace, IsExaminedWithThePlacesOfItsPoints) {
  const Scratch scratch;
  std::ofstream(scratch.path / "angle.msh") << msh;
  std::ofstream(scratch.path / "case.toml") << case_with("angle.msh");
  const Outcome check = plastron({"check", "case.toml"}, scratch.path);
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_THAT(check.output,
              AllOf(HasSubstr("stands for (0, 0.5, 1), 0.01 m away"), HasSubstr("1 folds"), HasSubstr("ready to run")));
  const Outcome classical = plastron({"check", "case.toml", "--set", "shell.formulation=\"classical\""}, scratch.path);
  EXPECT_EQ(classical.exit_code, 2);
  EXPECT_THAT(classical.output, HasSubstr("needs a smooth chart"));
}

}  // namespace
}  // namespace plastron::cli
