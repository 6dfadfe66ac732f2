// Every file of tests/config/wrong is refused with the words of its "# expect:" lines.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "config/expectations.hpp"

namespace plastron::config {
namespace {

namespace fs = std::filesystem;

const fs::path directory = fs::path(PLASTRON_SOURCE_DIR) / "tests/config/wrong";

std::vector<std::string> wrong_cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

using test::expectations;

std::string errors_of(const fs::path& file) {
  try {
    read_case(file);
  } catch (const CaseErrors& errors) {
    return errors.format();
  }
  return "";
}

class WrongCase : public testing::TestWithParam<std::string> {};

TEST_P(WrongCase, IsRefusedInTheExpectedWords) {
  const fs::path file = directory / (GetParam() + ".toml");
  const std::string errors = errors_of(file);
  EXPECT_NE(errors, "");
  const auto expected = expectations(file);
  EXPECT_FALSE(expected.empty());
  for (const std::string& words : expected) {
    const bool is_position = words.find(": error:") != std::string::npos && std::isdigit(words[0]);
    const std::string wanted = is_position ? ".toml:" + words : words;
    EXPECT_NE(errors.find(wanted), std::string::npos) << "missing: " << wanted << "\nin:\n" << errors;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, WrongCase, testing::ValuesIn(wrong_cases()), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(WrongCases, AreAtLeastFortyFive) { EXPECT_GE(wrong_cases().size(), 45u); }

// The files of tests/cli/wrong are wrong only in geometry or mechanics.
TEST(WrongCases, OfTheExaminationAreReadWithoutComplaint) {
  for (const auto& entry : fs::directory_iterator(fs::path(PLASTRON_SOURCE_DIR) / "tests/cli/wrong"))
    EXPECT_TRUE(entry.path().extension() != ".toml" || errors_of(entry.path()).empty()) << errors_of(entry.path());
}

TEST(WrongCases, ReportExactlyTheMistakesTheyHave) {
  EXPECT_EQ(std::ranges::count(errors_of(directory / "constant-wrong-is-reported-once.toml"), '^'), 1);
  EXPECT_EQ(std::ranges::count(errors_of(directory / "laminate-of-a-wrong-material.toml"), '^'), 1 + 1);  // and nu12^2
  try {
    read_case(directory / "many-at-once.toml");
    FAIL();
  } catch (const CaseErrors& errors) {
    EXPECT_EQ(errors.mistakes().size(), 9u) << errors.format();
    EXPECT_TRUE(std::ranges::is_sorted(errors.mistakes(), {}, &Mistake::line));
  }
}

TEST(UnreadableFiles, AreOneClearError) {
  const fs::path folder = fs::temp_directory_path();
  EXPECT_EQ(errors_of("/no/such/case.toml"), "/no/such/case.toml: error: there is no such file\n");
  EXPECT_NE(errors_of(folder).find("this is a directory"), std::string::npos);
  const auto refusal = [](const std::string& text) {
    try {
      parse_case(text, "case.toml");
    } catch (const CaseErrors& errors) {
      return errors.format();
    }
    return std::string();
  };
  EXPECT_EQ(refusal(""), "case.toml: error: the file is empty\n");
  EXPECT_EQ(refusal(" \n\t\n"), "case.toml: error: the file is empty\n");
  EXPECT_NE(refusal("title = \"caf\xE9\"\n").find("case.toml:1:13: error: byte 0xE9 is not UTF-8"), std::string::npos);
  EXPECT_NE(refusal(std::string("a = 1\0\n", 7)).find("case.toml:1:"), std::string::npos);
}

}  // namespace
}  // namespace plastron::config
