// docs/results.md contains the tables of the code. PLASTRON_WRITE_DOCS=1 rewrites them.
#include <plastron/io/fields.hpp>
#include <plastron/io/quantities.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <generated_table.hpp>
#include <io/scratch_directory.hpp>

#include <algorithm>
#include <cstdlib>

namespace plastron::io {

namespace {

const std::filesystem::path page = std::filesystem::path(PLASTRON_SOURCE_DIR) / "docs" / "results.md";

/// Paths in the page have dots and no '/'; '|' would end a cell of the table.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string dotted(std::string_view path) {
  std::string result(path);
  std::replace(result.begin(), result.end(), '/', '.');
  return result;
}

template <class Record>
std::string rows(const std::string& prefix, std::span<const Quantity<Record>> quantities) {
  std::string text;
  for (const auto& q : quantities)
    text += fmt::format("| `{}{}` | {} | {} |\n", prefix, dotted(q.path), q.unit, escaped(q.meaning));
  return text;
}

std::string quantities_table() {
  return "| path | unit | meaning |\n|---|---|---|\n" + rows("", result_quantities()) +
         rows("linearity.quantities[].", model_quantities()) + rows("modes[].", mode_quantities()) +
         rows("singular_places[].", singular_place_quantities()) + rows("layers[].", layer_quantities()) +
         rows("supports[].", support_quantities()) + rows("corner_supports[].", corner_support_quantities()) +
         rows("point_supports[].", point_support_quantities()) + rows("rigid_bodies[].", rigid_body_quantities()) +
         rows("contact.", contact_quantities()) + rows("contact.admissible.", admissible_quantities()) +
         rows("obstacles[].", obstacle_quantities()) + rows("obstacles[].zones[].", zone_quantities()) +
         rows("history[].", history_quantities()) + rows("estimates.", estimate_quantities()) +
         rows("estimates.goals[].", goal_quantities()) + rows("estimates.geometry.", geometry_quantities()) +
         rows("certificate.", certificate_quantities()) + rows("levels[].", level_quantities()) +
         rows("levels[].history[].", iteration_quantities());
}

std::string fields_table() {
  std::string text = "| in a probe | array in the .vtu file | symbol | unit | meaning |\n|---|---|---|---|---|\n";
  for (const Field& f : fields()) {
    std::string arrays;
    for (const std::string& name : f.arrays) arrays += fmt::format("{}`{}`", arrays.empty() ? "" : " ", name);
    text += fmt::format("| `{}` | {}{} | {} | {} | {} |\n", dotted(f.key), arrays, f.is_vector() ? " (vector)" : "",
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
