// `check` and `run` refuse every wrong case file with the words of its "# expect:" lines, and leave no files
// behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <future>

#include "cli/program.hpp"
#include "config/expectations.hpp"

namespace plastron::cli {
namespace {

constexpr double seconds_to_answer = 20;

/// tests/config/wrong and tests/cli/wrong, as far as they exist.
std::vector<fs::path> wrong_cases() {
  std::vector<fs::path> all;
  for (const char* folder : {"tests/config/wrong", "tests/cli/wrong"})
    if (const fs::path directory = fs::path(PLASTRON_SOURCE_DIR) / folder; fs::exists(directory))
      for (const auto& entry : fs::directory_iterator(directory))
        if (entry.path().extension() == ".toml") all.push_back(entry.path());
  std::ranges::sort(all);
  return all;
}

using test::expectations;

/// Long lines are broken at words and continue four characters to the right.
std::string unwrapped(std::string text) {
  for (std::size_t at = text.find("\n    "); at != std::string::npos; at = text.find("\n    ", at + 1))
    if (at + 5 < text.size() && text[at + 5] != ' ' && text[at + 5] != '|') text.replace(at, 5, " ");
  return text;
}

class WrongCase : public testing::TestWithParam<fs::path> {
 protected:
  void expect_refused(const Outcome& outcome) {
    EXPECT_FALSE(outcome.timed_out);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("error"), std::string::npos);
    for (const std::string& words : expectations(GetParam()))
      EXPECT_NE(unwrapped(outcome.output).find(words), std::string::npos) << "missing: " << words << "\nin:\n"
                                                                          << outcome.output;
  }
};

TEST_P(WrongCase, is_refused_in_the_expected_words_and_leaves_nothing_behind) {
  const Scratch scratch;
  EXPECT_FALSE(expectations(GetParam()).empty());
  // Both at once: there are many files, and the start takes the most time.
  auto run = std::async(std::launch::async, [&] {
    return plastron({"run", GetParam().string(), "--output", "X"}, scratch.path, seconds_to_answer);
  });
  expect_refused(plastron({"check", GetParam().string()}, scratch.path, seconds_to_answer));
  expect_refused(run.get());
  EXPECT_TRUE(fs::is_empty(scratch.path));
}

INSTANTIATE_TEST_SUITE_P(Files, WrongCase, testing::ValuesIn(wrong_cases()), [](const auto& test) {
  std::string name = test.param.parent_path().parent_path().filename().string() + "_" + test.param.stem().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(WrongCases, are_at_least_forty) { EXPECT_GE(wrong_cases().size(), 40u); }

}  // namespace
}  // namespace plastron::cli
