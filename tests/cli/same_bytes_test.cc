// A case gives the same bytes in every run, wherever the system places the program's memory.
#include <gtest/gtest.h>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

// A chart of many terms: the order of their sum affects the result.
const char* const bowl = R"([constants]
R = 1.0
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { disk = { radius = 0.4 } }
chart = ["x", "y", "0.035 + R - sqrt(R^2 - x^2 - y^2) + 0.01*x*y - 0.02*x^2*y + 0.03*sin(x + 2*y)^2"]
[mesh]
degree = 2
refinements = 2
[[support]]
boundary = "rim"
fix = ["u", "r"]
[[load]]
force = [0, 0, -1e-3]
[[obstacle]]
half_space = { point = [0, 0, 0], normal = [0, 0, 1] }
)";

TEST(SameCase, GivesTheSameBytesInEveryRun) {
  const Scratch scratch;
  scratch.write("bowl.toml", bowl);
  std::string first;
  for (int run = 0; run < 4; ++run) {
    const std::string directory = "out" + std::to_string(run);
    const Outcome outcome = plastron({"run", "bowl.toml", "--quiet", "--output", directory}, scratch.path);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::string fields = text_of(scratch.path / directory / "solution.vtu");
    ASSERT_FALSE(fields.empty());
    if (run == 0) first = fields;
    EXPECT_TRUE(fields == first) << "run " << run << " differs from the first one";
  }
}

}  // namespace
}  // namespace plastron::cli
