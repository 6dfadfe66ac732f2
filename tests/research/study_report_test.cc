// Reports of studies as text and files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/scratch_directory.hpp>
#include <research/report/study_report.hpp>

#include <cmath>

namespace plastron::study {
namespace {

using io::Json, io::ScratchDirectory, io::text_of, io::world_rank;
using testing::AllOf;
using testing::HasSubstr;

study::Report report() {
  study::Report r;
  r.table = {
      .name = "example",
      .title = "Does it work?",
      .columns = {{"mesh size", "h", "m"}, {"cells", "", "1"}, {"kind", "", "-"}, {"rate", "p", "1"}},
      .rows = {{0.5, std::int64_t{4}, std::string("coarse"), NAN}, {0.25, std::int64_t{16}, std::string("fine"), 2.0}},
      .fits = {{"error", "h", 1.98}},
      .claims = {study::judged("it works", "two of two", true), study::judged("it is fast", "no", false),
                 study::not_judged("it is free", "nobody asked")},
      .remarks = {"nothing else"}};
  r.plot = {.title = "Plot", .x = {"h [m]", true}, .y = {"error", true}, .series = {{"error", {0.5, 0.25}, {1, NAN}}}};
  return r;
}

TEST(StudyReport, is_a_table_with_units_and_plain_findings) {
  const std::string text = table_text(report().table);
  EXPECT_THAT(text, AllOf(HasSubstr("Does it work?"), HasSubstr("mesh size"), HasSubstr("[m]"), HasSubstr("coarse"),
                          HasSubstr("error ~ h^1.98"), HasSubstr("it works: two of two: holds\n"),
                          HasSubstr("it is fast: no: does not hold\n"),
                          HasSubstr("it is free: cannot be judged: nobody asked\n"), HasSubstr("nothing else")));
  EXPECT_THAT(text, testing::Not(HasSubstr("nan")));
}

TEST(StudyReport, in_JSON_has_rows_of_the_columns_and_null_for_what_is_not_there) {
  const Json json = report_json(report(), {.title = "T", .settings = {{"a", 1}}, .files = {"example.svg"}});
  EXPECT_EQ(json.at("status"), "solved");
  ASSERT_EQ(json.at("columns").size(), 4u);
  for (const Json& row : json.at("rows")) EXPECT_EQ(row.size(), 4u);
  EXPECT_TRUE(json.at("rows")[0][3].is_null());
  EXPECT_EQ(json.at("rows")[1][1], 16);
  EXPECT_EQ(json.at("columns")[0].at("unit"), "m");
  EXPECT_EQ(json.at("claims")[0].at("holds"), true);
  EXPECT_EQ(json.at("claims")[1].at("holds"), false);
  EXPECT_EQ(json.at("claims")[1].at("verdict"), "does not hold");
  EXPECT_TRUE(json.at("claims")[2].at("holds").is_null());
  EXPECT_EQ(json.at("claims")[2].at("verdict"), "cannot be judged");
  EXPECT_EQ(json.at("claims")[2].at("reason"), "nobody asked");
  EXPECT_EQ(json.at("settings").at("a"), 1);
  EXPECT_TRUE(json.at("plot").at("series")[0].at("y")[1].is_null());
}

TEST(StudyReport, has_no_exponent_where_none_could_be_fitted) {
  study::Report none = report();
  none.table.fits = {{"error", "h", NAN}};
  EXPECT_THAT(table_text(none.table), AllOf(HasSubstr("error: no exponent of h"), testing::Not(HasSubstr("nan"))));
  EXPECT_TRUE(report_json(none, {}).at("fits")[0].at("exponent").is_null());
}

TEST(StudyReport, is_written_as_two_whole_files) {
  const ScratchDirectory scratch("study");
  write_report(report(), {.title = "T", .settings = {}, .files = {}}, scratch.path / "deep", MPI_COMM_WORLD);
  const Json json = Json::parse(text_of(scratch.path / "deep" / "example.json"));
  EXPECT_EQ(json.at("files")[0], "example.svg");
  EXPECT_THAT(text_of(scratch.path / "deep" / "example.svg"), HasSubstr("</svg>"));
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(StudyReport, without_rows_leaves_no_plot_of_an_earlier_one) {
  const ScratchDirectory scratch("study-empty");
  write_report(report(), {}, scratch.path, MPI_COMM_WORLD);
  study::Report failed = report();
  failed.status = contact::Status::singular;
  failed.table.rows.clear();
  write_report(failed, {}, scratch.path, MPI_COMM_WORLD);
  EXPECT_THAT(scratch.names(), testing::ElementsAre("example.json"));
  EXPECT_EQ(Json::parse(text_of(scratch.path / "example.json")).at("status"), "singular");
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(StudyReport, that_cannot_be_written_keeps_an_earlier_one) {
  const ScratchDirectory scratch("study-fails");
  write_report(report(), {.title = "first", .settings = {}, .files = {}}, scratch.path, MPI_COMM_WORLD);
  const std::string before = text_of(scratch.path / "example.json");
  MPI_Barrier(MPI_COMM_WORLD);
  if (world_rank() == 0) {
    std::filesystem::remove(scratch.path / "example.svg");
    std::filesystem::create_directory(scratch.path / "example.svg");
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(write_report(report(), {.title = "second", .settings = {}, .files = {}}, scratch.path, MPI_COMM_WORLD),
               std::runtime_error);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(text_of(scratch.path / "example.json"), before);
  MPI_Barrier(MPI_COMM_WORLD);
}

// ---- pictures of meshes ------------------------------------------------------------------------------------------------

/// Two squares side by side. The right one has a neighbour half as large above it, and one vertex of this hangs.
study::MeshPicture squares() {
  return {.caption = "two squares",
          .cells = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{1, 0}, {1.5, 0}, {2, 0}, {2, 1}, {1, 1}}},
          .hanging = {{1.5, 1}},
          .touching = {{{0, 0}, {1, 0}, {1, 1}}}};
}

TEST(PicturesOfMeshes, show_cells_zone_and_hanging_vertices_once_each) {
  const std::vector pictures{squares(), squares()};
  const std::string svg = svg_of_meshes(pictures);
  EXPECT_THAT(svg, AllOf(HasSubstr("two squares"), HasSubstr("</svg>"), HasSubstr("class=\"zone\" d=\"M")));
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (auto at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("class=\"cells\" d="), 2);
  EXPECT_EQ(count("r=\"1.5\""), 2);
  EXPECT_EQ(count("z\"") + count("zM"), 2 * (2 + 1));  // closed polygons
  EXPECT_EQ(svg_of_meshes({}), "");
}

TEST(PicturesOfMeshes, are_written_beside_the_plot_and_do_not_outlive_their_report) {
  const ScratchDirectory scratch("study-meshes");
  study::Report with_meshes = report();
  with_meshes.meshes = {squares()};
  write_report(with_meshes, {}, scratch.path, MPI_COMM_WORLD);
  const Json json = Json::parse(text_of(scratch.path / "example.json"));
  EXPECT_EQ(json.at("files"), Json({"example.svg", "example-meshes.svg"}));
  EXPECT_THAT(text_of(scratch.path / "example-meshes.svg"), HasSubstr("two squares"));
  MPI_Barrier(MPI_COMM_WORLD);
  write_report(report(), {}, scratch.path, MPI_COMM_WORLD);
  EXPECT_THAT(scratch.names(), testing::UnorderedElementsAre("example.json", "example.svg"));
  MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace
}  // namespace plastron::study
