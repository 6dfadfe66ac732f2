// Damaged case files pass through the whole examination. `check` must end soon, with one of its exit codes.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.hpp"
#include "config/mutants.hpp"

namespace plastron::cli {
namespace {

TEST(Fuzz, EveryMutantIsExaminedOrRefused) {
  test::Mutants mutate(20260102);
  std::vector<fs::path> originals;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(PLASTRON_SOURCE_DIR) / "cases"))
    if (entry.path().extension() == ".toml") originals.push_back(entry.path());
  std::ranges::sort(originals);
  const Scratch scratch;
  int examined = 0;
  for (const fs::path& original : originals)
    for (int i = 0; i < 8; ++i) {
      const std::string mutant = mutate(text_of(original));
      scratch.write("case.toml", mutant);
      const Outcome outcome = plastron({"check", "case.toml"}, scratch.path, 20);
      EXPECT_FALSE(outcome.timed_out) << mutant;
      EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2) << outcome.exit_code << outcome.output << mutant;
      EXPECT_NE(outcome.output, "");
      if (outcome.output.find("case.toml:") != std::string::npos) ++examined;
    }
  EXPECT_GT(examined, 10);
}

}  // namespace
}  // namespace plastron::cli
