// The declarations, the structs they fill and the manual agree.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>
#include <plastron/config/schema.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

namespace plastron::config {
namespace {

const std::string manual = PLASTRON_SOURCE_DIR "/docs/case-file.md";

TEST(Declarations, NameEveryKeyOnceAndSayWhatItMeans) {
  std::set<std::string> paths;
  for (const Section& s : sections()) {
    EXPECT_TRUE(paths.insert(s.path).second) << s.path;
    std::set<std::string> keys;
    for (const Key& key : s.keys) {
      EXPECT_TRUE(keys.insert(key.name).second) << s.path << "." << key.name;
      EXPECT_FALSE(key.meaning.empty()) << key.name;
      EXPECT_EQ(key.kind == Kind::word || key.kind == Kind::word_or_false || key.kind == Kind::integer_or_word,
                !key.words.empty() && key.name != "fix")
          << key.name;
      EXPECT_FALSE(key.required && !key.fallback.empty()) << key.name << " is required and has a default";
      EXPECT_FALSE(key.required && !s.path.empty() && key.example.empty()) << key.name;
    }
  }
}

TEST(Ranges, AreWrittenAsInequalities) {
  EXPECT_EQ((Range{-1, 0.5, true, true}).text("nu"), "-1 < nu < 0.5");
  EXPECT_EQ((Range{.low = 1}).text("n"), "n >= 1");
  EXPECT_EQ((Range{.high = 2}).text("n"), "n <= 2");
  EXPECT_EQ(Range{}.text("n"), "");
  EXPECT_FALSE((Range{.low = 0, .low_open = true}).contains(0));
  EXPECT_TRUE((Range{.low = 0}).contains(0));
}

TEST(Defaults, OfTheFileAreThoseOfTheProgram) {
  const Case c = parse_case(
      "[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\ndomain = { disk = { radius = 1 } }\nchart = [\"x\", \"y\", "
      "0]\n[mesh]\n"
      "[[obstacle]]\nhalf_space = {}\n",
      "case.toml");
  const problem::Problem fresh;
  EXPECT_EQ(c.problem.discretisation.degree, fresh.discretisation.degree);
  EXPECT_EQ(c.problem.shell.tying, fresh.shell.tying);
  EXPECT_EQ(c.problem.discretisation.refinements, fresh.discretisation.refinements);
  EXPECT_EQ(c.problem.contact.max_iterations, fresh.contact.max_iterations);
  EXPECT_EQ(c.problem.contact.gap_tolerance, fresh.contact.gap_tolerance);
  EXPECT_EQ(c.problem.contact.multiplier_tolerance, fresh.contact.multiplier_tolerance);
  EXPECT_EQ(c.problem.contact.linear_tolerance, fresh.contact.linear_tolerance);
  EXPECT_EQ(c.problem.shell.sections.common.material.shear_correction,
            fresh.shell.sections.common.material.shear_correction);
  EXPECT_EQ(c.problem.shell.obstacles.all.at(0).face, obstacle::Obstacle{}.face);
  EXPECT_EQ(std::get<obstacle::HalfSpace>(c.problem.shell.obstacles.all.at(0).shape).point,
            obstacle::HalfSpace{}.point);
  EXPECT_EQ(std::get<obstacle::HalfSpace>(c.problem.shell.obstacles.all.at(0).shape).normal,
            obstacle::HalfSpace{}.normal);
}

TEST(Manual, IsWhatTheDeclarationsSay) {
  if (std::getenv("PLASTRON_WRITE_DOCS")) std::ofstream(manual) << describe_case_format();
  std::ifstream stream(manual);
  const std::string committed(std::istreambuf_iterator<char>(stream), {});
  EXPECT_TRUE(committed == describe_case_format()) << "docs/case-file.md is out of date. Write it anew with\n  "
                                                      "PLASTRON_WRITE_DOCS=1 config_test --gtest_filter=Manual.*";
}

TEST(Manual, HasAnExampleThatIsACase) {
  const std::string text = describe_case_format(), fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  EXPECT_NO_THROW(parse_case(text.substr(begin, text.find("```", begin) - begin), "case.toml"));
}

}  // namespace
}  // namespace plastron::config
