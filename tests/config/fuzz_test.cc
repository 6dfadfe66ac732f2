// Damaged case files. Reading them ends soon, in a case or in a message without control characters.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>
#include <plastron/config/printable.hpp>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "config/mutants.hpp"

namespace plastron::config {
namespace {

namespace fs = std::filesystem;
constexpr double patience = 2;  // [s] of the processor

/// The case files of the examples and of the tests.
std::vector<fs::path> originals() {
  std::vector<fs::path> all;
  for (const char* folder : {"cases", "tests/config/wrong", "tests/cli/wrong"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PLASTRON_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".toml") all.push_back(entry.path());
  std::ranges::sort(all);
  return all;
}

struct Outcome {
  bool accepted = false;
  double seconds = 0;
};

Outcome read(const std::string& text, const fs::path& original) {
  const std::clock_t start = std::clock();
  Outcome outcome;
  try {
    parse_case(text, original.string());
    outcome.accepted = true;
  } catch (const CaseErrors& errors) {
    const std::string message = errors.format();
    EXPECT_NE(message, "");
    EXPECT_EQ(printable(message, LineBreaks::keep), message);
    EXPECT_LT(message.size(), 100000u);
  }
  outcome.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  return outcome;
}

TEST(Fuzz, EveryMutantIsReadOrRefusedSoon) {
  test::Mutants mutate(20260101);
  int accepted = 0, refused = 0;
  for (const fs::path& path : originals()) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    for (int i = 0; i < 6; ++i) {
      const std::string mutant = mutate(text);
      const Outcome outcome = read(mutant, path);
      EXPECT_LT(outcome.seconds, patience) << path << " mutant " << i << ":\n" << mutant.substr(0, 2000);
      (outcome.accepted ? accepted : refused)++;
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(accepted, 10) << "the mutants are not near enough to real cases";
}

}  // namespace
}  // namespace plastron::config
