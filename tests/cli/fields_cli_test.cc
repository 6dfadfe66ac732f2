// The .vtu files of every case in cases/ are read back. Every number of every field is finite, and every field has a unit.
#include <gtest/gtest.h>
#include <io/vtu_reader.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

/// Names of the fields; all of them were examined.
std::set<std::string> checked_fields(const fs::path& file) {
  const io::VtuFile grid = io::read_vtu(file);
  EXPECT_GT(grid.points, 0U) << file;
  std::set<std::string> names;
  for (const auto& [name, array] : grid.arrays) {
    const std::size_t places = name == "error_indicator" ? grid.cells : grid.points;
    EXPECT_EQ(array.values.size(), places * static_cast<std::size_t>(array.components)) << file << ": " << name;
    for (const double value : array.values) {
      if (std::isfinite(value)) continue;
      ADD_FAILURE() << file << ": " << name << " is not finite";
      break;
    }
    if (name == "points") continue;
    EXPECT_FALSE(array.unit.empty()) << file << ": " << name << " has no unit";
    names.insert(name);
  }
  return names;
}

TEST(FieldsOfEveryCase, AreFiniteAndHaveUnits) {
  std::size_t cases = 0;
  for (const auto& entry : fs::directory_iterator(PLASTRON_SOURCE_DIR "/cases")) {
    const fs::path file = entry.path() / "case.toml";
    if (!fs::exists(file)) continue;
    ++cases;
    const Scratch scratch;
    std::vector<std::string> words{"run", file.string(), "-q", "--no-report", "-o", "out"};
    std::vector<std::string> settings{"mesh.refinements=0", "mesh.degree=2", "output.solid=true", "output.layers=1",
                                      "output.heights=[0.1]"};
    if (text_of(file).find("[accuracy]") != std::string::npos) settings.push_back("accuracy.max_unknowns=1");
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Outcome run = plastron(words, scratch.path);
    ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << file << run.output;  // coarse meshes may miss a limit
    const auto results = nlohmann::json::parse(text_of(scratch.path / "out/results.json"));
    std::set<std::string> told;
    for (const auto& field : results["fields"])
      for (const auto& array : field["arrays"]) told.insert(array.get<std::string>());
    EXPECT_EQ(checked_fields(scratch.path / "out/solution.vtu"), told) << file;
    EXPECT_TRUE(told.contains("von_mises_at_0.1"));
    EXPECT_TRUE(checked_fields(scratch.path / "out/solid.vtu").contains("stress")) << file;
  }
  EXPECT_GE(cases, 15U);
}

}  // namespace
}  // namespace plastron::cli
