#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

namespace plastron::config {
namespace {

TEST(Format, IsThatOfACompiler) {
  const Mistake mistake{.file = "case.toml",
                        .line = 12,
                        .column = 1,
                        .length = 8,
                        .source_line = "thicknes = 0.1",
                        .what = "unknown key \"thicknes\" in [shell]",
                        .allowed = "E, thickness",
                        .advice = "did you mean \"thickness\"?"};
  EXPECT_EQ(format(mistake),
            "case.toml:12:1: error: unknown key \"thicknes\" in [shell]\n"
            "   12 | thicknes = 0.1\n"
            "      | ^~~~~~~~\n"
            "   allowed: E, thickness\n"
            "   did you mean \"thickness\"?\n");
}

TEST(Format, HasNoCaretForTheFileAsAWhole) {
  EXPECT_EQ(format({.file = "a.toml", .what = "the file is empty"}), "a.toml: error: the file is empty\n");
}

TEST(Format, KeepsTheCaretBelowItsCharacter) {
  const Mistake mistake{.file = "a", .line = 1, .column = 6, .length = 100, .source_line = "\té = é1", .what = "w"};
  EXPECT_EQ(format(mistake), "a:1:6: error: w\n    1 | \té = é1\n      | \t    ^~\n");
}

TEST(CaseErrorsSorted, ComeInTheOrderOfTheFile) {
  const CaseErrors errors({{.file = "a", .line = 3, .what = "third"}, {.file = "a", .line = 1, .what = "first"}});
  EXPECT_EQ(errors.mistakes().front().what, "first");
  EXPECT_EQ(errors.format(), errors.what());
}

// The message of parse_case about a text with one mistake.
Mistake only_mistake(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const CaseErrors& errors) {
    if (errors.mistakes().size() == 1) return errors.mistakes().front();
    ADD_FAILURE() << errors.format();
    return {};
  }
  ADD_FAILURE() << "no mistake found in\n" << text;
  return {};
}

std::string with_thickness(const std::string& thickness) {
  return "[geometry]\ndomain = { disk = { radius = 1 } }\nchart = [\"x\", \"y\", \"0\"]\n[shell]\nE = 1\nnu = 0\n"
         "thickness = " +
         thickness + "\n";
}

// The key that it means was told as missing, too.
TEST(MistypedKey, IsOneMistakeAlsoWhereTheKeyIsRequired) {
  const std::pair<std::string, std::string> cases[] = {{"thicknes", "thickness"},  {"thikness", "thickness"},
                                                       {"Thickness", "thickness"}, {"chrat", "chart"},
                                                       {"geometri", "geometry"},   {"shel", "shell"}};
  for (const auto& [wrong, right] : cases) {
    std::string text = with_thickness("0.1");
    text.replace(text.find(right), right.size(), wrong);
    EXPECT_NE(only_mistake(text).advice.find(right), std::string::npos) << wrong;
  }
}

TEST(UnknownKey, InALoadIsNotAlsoALoadOfNothing) {
  EXPECT_EQ(only_mistake(with_thickness("0.1") + "[[load]]\ntemperature = 50\n").what,
            "unknown key \"temperature\" in [[load]]");
}

TEST(Caret, StandsAtTheWrongCharacterInsideAnyKindOfString) {
  EXPECT_EQ(only_mistake(with_thickness("\"1 + q\"")).column, 18);
  EXPECT_EQ(only_mistake(with_thickness("'1 + q'")).column, 18);
  EXPECT_EQ(only_mistake(with_thickness("\"\"\"1 + q\"\"\"")).column, 20);
  EXPECT_EQ(only_mistake(with_thickness("\"\"\"\n1 + q\"\"\"")).line, 8);
  EXPECT_EQ(only_mistake(with_thickness("\"\"\"\n1 + q\"\"\"")).column, 5);
  EXPECT_EQ(only_mistake(with_thickness("\"1\\t+ q\"")).column, 19);
  EXPECT_EQ(only_mistake(with_thickness("\"1 + quarter\"")).length, 7);
}

TEST(Caret, CountsCharactersNotBytes) {
  EXPECT_EQ(only_mistake("é = 1\n").column, 1);
  EXPECT_EQ(only_mistake(with_thickness("\"1\" # é\n'é' = 2")).length, 3);
}

TEST(LineEnds, OfWindowsAndAByteOrderMarkAreUnderstood) {
  std::string text = "\xEF\xBB\xBF" + with_thickness("\"1 + q\"");
  for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 2)) text.insert(i, "\r");
  const Mistake mistake = only_mistake(text);
  EXPECT_EQ(mistake.line, 7);
  EXPECT_EQ(mistake.column, 18);
  EXPECT_EQ(mistake.source_line, "thickness = \"1 + q\"");
}

}  // namespace
}  // namespace plastron::config
