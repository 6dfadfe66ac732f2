// docs/results.md contains the tables of the code. PLASTRON_WRITE_DOCS=1 rewrites them.
#include <plastron/io/fields.hpp>
#include <plastron/io/results_schema.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <generated_table.hpp>
#include <io/scratch_directory.hpp>

#include <algorithm>
#include <cstdlib>

namespace plastron::io {

namespace {

const std::filesystem::path page = std::filesystem::path(PLASTRON_SOURCE_DIR) / "docs" / "results.md";

/// '|' would end a cell of the table.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string quantities_table() {
  std::string text = "| path | unit | meaning |\n|---|---|---|\n";
  for (const Part& part : parts()) {
    // The table of fields has the entries of probes, obstacles[] those of obstacles in the history.
    const bool is_repeated = part.place.find("probes/") != part.place.npos || part.place == "history/*/obstacles/*/";
    if (is_repeated) continue;
    for (const Entry& entry : part.entries)
      text += fmt::format("| `{}` | {} | {} |\n", dotted(part.place, entry.path), entry.unit, escaped(entry.meaning));
  }
  return text;
}

std::string fields_table() {
  std::string text = "| in a probe | array in the .vtu file | symbol | unit | meaning |\n|---|---|---|---|---|\n";
  for (const Field& f : fields()) {
    std::string arrays;
    for (const std::string& name : f.arrays) arrays += fmt::format("{}`{}`", arrays.empty() ? "" : " ", name);
    text += fmt::format("| `{}` | {}{} | {} | {} | {} |\n", dotted("", f.key), arrays, f.is_vector() ? " (vector)" : "",
                        f.symbol, f.unit, f.meaning);
  }
  return text;
}

using test::with_table;

TEST(Documentation, holds_the_tables_of_the_code) {
  if (world_rank() != 0) return;
  const std::string text = text_of(page);
  const std::string expected = with_table(with_table(text, "quantities", quantities_table()), "fields", fields_table());
  if (std::getenv("PLASTRON_WRITE_DOCS") != nullptr) std::ofstream(page) << expected;
  EXPECT_EQ(text_of(page), expected) << "run io_test with PLASTRON_WRITE_DOCS=1";
}

}  // namespace

}  // namespace plastron::io
