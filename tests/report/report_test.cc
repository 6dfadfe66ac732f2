// report.html: its data are those of results.json and of the solution, nothing of the case becomes markup, and it stays small.
#include <plastron/io/bytes.hpp>
#include <plastron/io/obstacle_surfaces.hpp>
#include <plastron/report/report.hpp>
#include <plastron/report/report_html.hpp>
#include <plastron/report/report_scene.hpp>
#include <plastron/workflow/output.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>
#include <report/decoded_base64.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::report {

namespace {

using namespace io;  // NOLINT: what a page is made of, and helpers of tests
using testing::HasSubstr;
using testing::Not;
using workflow::Output, workflow::write_output;

/// The content of the script element of that name as the browser's parser takes it: up to the first "</script".
std::string block(const std::string& page, const std::string& id) {
  const std::string open = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t begin = page.find(open) + open.size();
  return page.substr(begin, page.find("</script", begin) - begin);
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// A row of a field; a single number stands for all.
std::vector<float> row_of(const Json& scene, const std::string& key, std::size_t component) {
  const auto points = scene["points"].get<std::size_t>();
  for (const Json& field : scene["fields"])
    if (field["key"] == Json(key)) {
      const Json& values = field["values"][component];
      if (values.is_number()) return std::vector<float>(points, values.get<float>());
      return decoded_numbers<float>(values.get<std::string>());
    }
  ADD_FAILURE() << "no field " << key;
  return {};
}

computation::Result solved(const PressedPlate& plate) {
  return computation::solve(pressed_plate(plate), MPI_COMM_WORLD);
}

TEST(Base64, encodes_as_rfc_4648_says) {
  EXPECT_EQ(base64(std::string()), "");
  EXPECT_EQ(base64(std::string("f")), "Zg==");
  EXPECT_EQ(base64(std::string("fo")), "Zm8=");
  EXPECT_EQ(base64(std::string("foobar")), "Zm9vYmFy");
  EXPECT_EQ(decoded(base64(std::string("\xff\x00\x7f", 3))), std::string("\xff\x00\x7f", 3));
}

TEST(Page, is_filled_once_and_only_where_it_has_places) {
  EXPECT_EQ(filled("a {{x}} b {{y}}{{x}}", {{"x", "{{y}}"}, {"y", "2"}}), "a {{y}} b 2{{y}}");
  EXPECT_THROW(filled("{{z}}", {}), std::logic_error);
}

TEST(Report, holds_the_numbers_of_results_json_and_all_sections) {
  const ScratchDirectory scratch("report");
  const computation::Result result = solved({.degree = 2, .refinements = 2});
  write_output(result, {.title = "plate", .settings = {}, .files = {}}, scratch.path, "solution", MPI_COMM_WORLD);
  const std::string page = text_of(scratch.path / "report.html");
  const Json results = Json::parse(text_of(scratch.path / "results.json"));
  EXPECT_EQ(Json::parse(block(page, "plastron-results")), results);
  EXPECT_THAT(results["files"].dump(), HasSubstr("report.html"));
  // A number that the page shows carries all its digits and its place.
  const std::string energy = results["energy"].dump();
  EXPECT_THAT(page, HasSubstr("data-path=\"energy\" title=\"" + energy + "\""));
  // Tiles show four digits: estimated errors are larger than the others.
  EXPECT_THAT(page, HasSubstr(fmt::format("title=\"{}\">{:.4g}<", energy, results["energy"].get<double>())));
  for (const char* what : {"N 11 [N/m]", "M 11 [N]", "stress 11 [Pa]", "lower face", "upper face"})
    EXPECT_THAT(page, HasSubstr(what));
  // The share that the linear model omits stands at the top.
  EXPECT_LT(page.find("data-path=\"linearity/max_strain\""), page.find("<section"));
  EXPECT_THAT(page, HasSubstr("The von Mises stress is largest at ("));
  for (const char* id :
       {"shell", "estimates", "balance", "contact", "probes", "plots", "certificate", "levels", "files"})
    EXPECT_EQ(occurrences(page, std::string("<section id=\"") + id + "\""), 1U) << id;
  EXPECT_EQ(occurrences(page, "data:image/svg+xml;base64,"), 5U);  // energy, reaction, area, nodes, changes
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST(Report, shows_the_surface_that_the_vtu_file_has) {
  const computation::Result result = solved({.degree = 2, .refinements = 2});
  const Json scene = scene_json(*result.solution, result.summary);
  EXPECT_EQ(scene.is_null(), world_rank() != 0);
  if (world_rank() != 0) return;
  EXPECT_EQ(scene["cells"], Json(64));
  EXPECT_EQ(scene["points"], Json(64 * 9));
  const auto x = row_of(scene, "position", 0), gap = row_of(scene, "gap", 0), u = row_of(scene, "u", 2);
  ASSERT_EQ(x.size(), 64U * 9U);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_GE(x[i], 0);
    EXPECT_LE(x[i], 2);
    EXPECT_NEAR(gap[i], 0.002 + u[i], 1e-9);  // the plate hangs 0.002 over the plane
  }
  EXPECT_NEAR(-*std::ranges::min_element(u), result.summary.max_displacement, 1e-8);
  EXPECT_EQ(scene["obstacles"].size(), 1U);
  EXPECT_EQ(scene["lines"].size(), result.summary.obstacles[0].zones[0].lines.size());
  EXPECT_EQ(scene["touches_on_areas"], !result.summary.obstacles[0].zones[0].is_line());
  // The load acts downwards everywhere: an arrow in each of nine parts by five.
  const auto directions = decoded_numbers<float>(scene["loads"]["directions"].get<std::string>());
  ASSERT_EQ(directions.size(), 3U * 45U);
  for (std::size_t i = 0; i < directions.size(); ++i) EXPECT_NEAR(directions[i], i % 3 == 2 ? -1 : 0, 1e-6);
}

TEST(Report, holds_the_instants_of_the_steps) {
  problem::Problem problem = pressed_plate({.degree = 2, .refinements = 1});
  problem.steps = {{.name = "load", .parts = 3}};
  problem.shell.obstacles.all[0].motions = {{.translation = {0, 0, 3e-4}}};
  SceneFrames frames;
  std::vector<double> largest;
  const computation::Result result = computation::solve(
      problem, MPI_COMM_WORLD,
      {.instant = [&](const computation::HistoryEntry& entry, const computation::Solution& solution) {
        frames.add(entry, solution);
        largest.push_back(entry.summary.max_displacement);
      }});
  const Json scene = scene_json(*result.solution, result.summary, {}, frames);
  if (world_rank() != 0) return;
  ASSERT_EQ(scene["frames"].size(), 2U);  // the last instant is the scene itself
  EXPECT_NEAR(scene["time"].get<double>(), 1, 1e-15);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& frame = scene["frames"][i];
    EXPECT_NEAR(frame["time"].get<double>(), (static_cast<double>(i) + 1) / 3, 1e-15);
    const auto u = decoded_numbers<float>(frame["u"][2].get<std::string>());
    ASSERT_EQ(u.size(), scene["points"].get<std::size_t>());
    EXPECT_NEAR(-*std::ranges::min_element(u), largest[i], 1e-8);
    EXPECT_EQ(frame["eta"].size(), 1U);
    // From the place in the end back to that of the frame.
    EXPECT_NEAR(frame["obstacles"][0]["translation"][2].get<double>(), -1e-4 * (2 - static_cast<double>(i)), 1e-15);
    EXPECT_EQ(frame["obstacles"][0]["rotation"][0], Json(1.0));
  }
}

TEST(Report, shows_no_pressure_below_zero_between_nodes) {
  const computation::Result result = solved({.degree = 4, .refinements = 1});
  const Json scene = scene_json(*result.solution, result.summary);
  if (world_rank() != 0) return;
  const auto eta = row_of(scene, "eta", 0);
  EXPECT_GT(*std::ranges::max_element(eta), 0);
  EXPECT_GE(*std::ranges::min_element(eta), 0);
}

/// The row of a goal in the table of estimated errors.
std::string goal_row(Json results, const std::string& status, const Json& goal) {
  results["status"] = status;
  Json& only = results["estimates"]["goals"] = Json::array({results["estimates"]["goals"][0]});
  only[0].update(goal);
  const std::string page = report_html(results, nullptr);
  const std::size_t table = page.find("<section id=\"estimates\">"),
                    begin = page.find("<tr", page.find("<tbody>", table));
  return page.substr(begin, page.find("</tr>", begin) - begin);
}

TEST(Report, says_which_accuracy_is_reached_by_the_rule_of_the_accuracy) {
  const Json results = results_json(solved({.degree = 2, .refinements = 2}), {});
  const auto missed = HasSubstr("<strong>missed</strong>"), reached = HasSubstr("&#10003; reached");
  struct Row {
    Json goal;
    bool is_reached;
  };
  for (const auto& [goal, is_reached] :
       {Row{{{"value", 1}, {"error", 4e-4}, {"scale", 1}, {"tolerance", 1e-3}}, true},
        Row{{{"value", 1}, {"error", 6e-4}, {"scale", 1}, {"tolerance", 1e-3}}, false},      // twice the error counts
        Row{{{"value", 1e-15}, {"error", 1e-12}, {"scale", 1}, {"tolerance", 1e-3}}, true},  // a sum that cancels
        Row{{{"value", 0}, {"error", 0}, {"scale", 0}, {"tolerance", 1e-3}}, true},  // an obstacle without contact
        Row{{{"value", 1}, {"error", 0}, {"scale", 1}, {"tolerance", 1e-3}, {"has_dual", false}}, false},
        Row{{{"value", 1}, {"error", nullptr}, {"scale", 1}, {"tolerance", 1e-3}}, false}}) {
    const std::string row = goal_row(results, "accuracy_not_reached", goal);
    EXPECT_THAT(row, is_reached ? reached : missed) << goal;
    EXPECT_EQ(row.starts_with("<tr class=\"missed\">"), !is_reached) << row;
    EXPECT_THAT(row, HasSubstr("data-path=\"estimates/goals/0/tolerance\""));
    EXPECT_THAT(goal_row(results, "solved", goal), reached) << goal;
  }
  EXPECT_THAT(goal_row(results, "inaccurate", {{"tolerance", nullptr}}), Not(testing::AnyOf(missed, reached)));
}

TEST(Report, mutes_forces_that_are_rounding_beside_the_contact_pressures) {
  Json results = results_json(solved({.degree = 2, .refinements = 2}), {});
  const auto forces = [&](const std::string& id) {
    const std::string page = report_html(results, nullptr);
    const std::size_t begin = page.find("<section id=\"" + id + "\">");
    return page.substr(begin, page.find("</section>", begin) - begin);
  };
  const double force = results["contact"]["max_pressure"].get<double>() * results["contact"]["area"].get<double>();
  const auto set = [&](double value) {
    for (const char* path : {"/loads/force", "/support_reaction/force", "/obstacles/0/reaction/force",
                             "/obstacles/0/zones/0/reaction/force"})
      results[Json::json_pointer(path)] = {value, 0, 0};
  };
  const std::string muted = "class=\"number rounding\" data-path=\"obstacles/0/";
  set(1e-12 * force);  // a ring on a shaft: large pressures without a sum
  EXPECT_THAT(forces("balance"), HasSubstr(muted + "reaction/force/0"));
  EXPECT_THAT(forces("contact"), HasSubstr(muted + "zones/0/reaction/force/0"));
  set(1e-3 * force);
  EXPECT_THAT(forces("balance"), Not(HasSubstr(muted + "reaction/force/0")));
  EXPECT_THAT(forces("contact"), Not(HasSubstr(muted + "zones/0/reaction/force/0")));
}

TEST(Report, has_the_units_of_the_case) {
  Provenance provenance;
  provenance.units = {"mm", "N"};
  const std::string page = report_html(results_json(solved({.degree = 2, .refinements = 2}), provenance), nullptr);
  const std::size_t begin = page.find("<section id=\"certificate\">");
  const std::string certificate = page.substr(begin, page.find("</section>", begin) - begin);
  for (const char* cell : {">MPa</td>", ">mm</td>", ">MPa mm</td>"}) EXPECT_THAT(certificate, HasSubstr(cell));
  for (const char* other : {">Pa</td>", ">m</td>", ">Pa m</td>"}) EXPECT_THAT(page, Not(HasSubstr(other)));
}

TEST(Report, merges_cells_to_blocks_where_there_are_too_many_points) {
  for (const mesh::Shape shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
    const computation::Result result = solved({.degree = 2, .refinements = 2, .shape = shape});
    const std::int64_t cells = result.levels.back().cells, corners = mesh::corner_count(shape);
    const Json scene = scene_json(*result.solution, result.summary, {}, {}, cells * corners / 4);
    const Json all = scene_json(*result.solution, result.summary, {}, {}, cells * corners);
    if (world_rank() != 0) continue;
    EXPECT_EQ(scene["merged"], Json(2));
    EXPECT_EQ(scene["points"], Json(cells * corners / 4));
    EXPECT_EQ(all["merged"], Json(1));
    // The corners of the blocks are points of the cells, with their values. All blocks together are the plate.
    const auto x = row_of(scene, "position", 0), y = row_of(scene, "position", 1), u = row_of(scene, "u", 2);
    const auto all_x = row_of(all, "position", 0), all_y = row_of(all, "position", 1), all_u = row_of(all, "u", 2);
    double area = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      double nearest = 1;
      for (std::size_t k = 0; k < all_x.size(); ++k)
        nearest = std::min<double>(nearest, std::hypot(x[i] - all_x[k], y[i] - all_y[k], 1e3 * (u[i] - all_u[k])));
      EXPECT_LT(nearest, 1e-6);
      if (i % static_cast<std::size_t>(corners) == 0)
        area += std::abs((x[i + 1] - x[i]) * (y[i + 2] - y[i]) - (x[i + 2] - x[i]) * (y[i + 1] - y[i])) *
                (corners == 3 ? 0.5 : 1);
    }
    EXPECT_NEAR(area, 2, 1e-5);
  }
}

std::vector<std::int64_t> uniform(std::int64_t cells, std::size_t levels) {
  std::vector<std::int64_t> by_level(levels + 1, 0);
  by_level.back() = cells;
  return by_level;
}

TEST(Report, merges_the_smallest_cells_of_a_graded_mesh_only) {
  const std::vector<std::int64_t> cells{3, 4, 0, 64};  // 64 of an eighth, in a coarse cell of their own
  EXPECT_EQ(drawn_cells(mesh::Shape::quadrilateral, 1, cells, 4 * 71).merged_levels, 0);
  EXPECT_EQ(drawn_cells(mesh::Shape::quadrilateral, 1, cells, 4 * 70).count, 3 + 4 + 16);
  EXPECT_EQ(drawn_cells(mesh::Shape::quadrilateral, 1, cells, 4 * 20).count, 3 + 4 + 4);
  EXPECT_EQ(drawn_cells(mesh::Shape::quadrilateral, 1, cells, 4 * 5).count, 3 + 1 + 1);
}

TEST(Report, stays_below_twelve_megabytes_for_a_hundred_thousand_points) {
  const DrawnCells drawn = drawn_cells(mesh::Shape::quadrilateral, 3, uniform(6400, 5), most_report_points);
  EXPECT_EQ(drawn.subdivisions, 1);  // a cell keeps four of 102 400 points
  EXPECT_EQ(drawn.merged_levels, 0);
  EXPECT_LE(drawn.count * 4, most_report_points);
  EXPECT_EQ(drawn_cells(mesh::Shape::quadrilateral, 1, uniform(1 << 20, 10), most_report_points).merged_levels, 4);
  EXPECT_EQ(drawn_cells(mesh::Shape::triangle, 2, uniform(100'000, 0), most_report_points).count, 0);
  // The largest possible page: all components of all fields at all points, and the rest of the page.
  std::size_t components = 0;
  for (const Field& field : report_fields({.obstacle = true, .multiplier = true, .foundation = true}))
    components += static_cast<std::size_t>(field.components);
  const double fields_size = static_cast<double>(components * most_report_points) * 16 / 3;
  const double obstacles_size = 60'000 * (12 + 6) * 4.0 / 3;
  const std::string page = report_html(results_json({}, {}), nullptr);
  EXPECT_LT(fields_size + obstacles_size + static_cast<double>(page.size()), 12e6);
}

TEST(Report, of_texts_that_look_like_markup_shows_them_as_text) {
  const std::string evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\" ' & {{script}} <!-- \xff";
  problem::Problem problem = pressed_plate({.degree = 1, .refinements = 1});
  problem.shell.obstacles.all.front().name = evil;
  problem.probes.front().name = evil;
  const ScratchDirectory scratch("evil");
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  write_output(result, {.title = evil, .settings = {{"obstacle", Json::array({{{"name", evil}}})}}, .files = {}},
               scratch.path, "solution", MPI_COMM_WORLD);
  const std::string page = text_of(scratch.path / "report.html");
  const std::string plain = report_html(results_json({}, {.title = "plain", .settings = {}, .files = {}}), nullptr);
  EXPECT_EQ(occurrences(page, "<script"), occurrences(plain, "<script"));
  EXPECT_EQ(occurrences(page, "</script"), occurrences(plain, "</script"));
  EXPECT_EQ(occurrences(page, "<!--"), occurrences(plain, "<!--"));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, Not(HasSubstr("\xff")));
  EXPECT_THAT(page, HasSubstr("<h1>&lt;/script&gt;&lt;script&gt;alert(1)"));
  EXPECT_EQ(Json::parse(block(page, "plastron-results")), Json::parse(text_of(scratch.path / "results.json")));
}

TEST(Report, tells_clamped_edges_from_those_on_which_the_shell_may_turn) {
  problem::Problem problem = pressed_plate({.degree = 2, .refinements = 1});
  problem.shell.supports.front().components.resize(3);  // u without r, on the left
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  const Json scene = scene_json(*result.solution, result.summary);
  if (world_rank() != 0) return;
  EXPECT_EQ(scene["supports"].size(), 16U);
  for (const Json& side : scene["supports"])
    EXPECT_EQ(side["clamped"].get<bool>(), side["boundary"] != Json("left")) << side["boundary"];
}

TEST(Report, names_a_load_of_zero) {
  const Json load{{"name", "wind"}, {"force", {0.0, 0.0, 0.0}}, {"pressure", 0.0}, {"couple", {0.0, 0.0, 0.0}}};
  const Json settings{{"load", Json::array({load})}};
  const std::string page = report_html(results_json({}, {.title = "", .settings = settings, .files = {}}), nullptr);
  EXPECT_THAT(page, HasSubstr("name wind, force 0 on the surface"));
}

TEST(Report, of_steps_has_their_history) {
  problem::Problem problem = pressed_plate({.degree = 2, .refinements = 1});
  problem.steps = {{.name = "press <slowly>", .parts = 2}};
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  const std::string page = report_html(results_json(result, {}), nullptr);
  EXPECT_THAT(page, HasSubstr("<section id=\"history\">"));
  EXPECT_EQ(occurrences(page, "press &lt;slowly&gt;"), 2U);
}

TEST(Report, that_is_refused_is_not_written_and_an_earlier_one_goes) {
  const ScratchDirectory scratch("refused");
  const computation::Result result = solved({.degree = 1, .refinements = 0});
  Output(scratch.path, "solution", MPI_COMM_WORLD).finish(result, {});
  EXPECT_TRUE(std::filesystem::exists(scratch.path / "report.html"));
  MPI_Barrier(MPI_COMM_WORLD);
  Output(scratch.path, "solution", MPI_COMM_WORLD, false).finish(result, {});
  MPI_Barrier(MPI_COMM_WORLD);  // the first rank removes it
  EXPECT_FALSE(std::filesystem::exists(scratch.path / "report.html"));
  EXPECT_THAT(text_of(scratch.path / "results.json"), Not(HasSubstr("report.html")));
}

TEST(ThinnedSurface, has_few_triangles_with_points_of_its_own) {
  obstacle::TriangleMesh grid;
  constexpr int n = 120;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) grid.points.emplace_back(i / double{n}, j / double{n}, 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = (n + 1) * j + i;
      grid.triangles.push_back({a, a + 1, a + n + 2});
      grid.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  EXPECT_EQ(thinned_surface(grid, grid.triangles.size()).triangles, grid.triangles);
  const obstacle::TriangleMesh few = thinned_surface(grid, 5000);
  EXPECT_LE(few.triangles.size(), 5000U);
  EXPECT_GE(few.triangles.size(), 2 * 46U * 46U);
  for (const auto& p : few.points) EXPECT_EQ(p[2], 0);
}

}  // namespace

}  // namespace plastron::report
