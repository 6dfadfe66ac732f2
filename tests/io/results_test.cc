#include <plastron/io/results.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/scratch_directory.hpp>

#include <limits>
#include <map>

namespace plastron::io {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

recovery::PointValues some_point() {
  recovery::PointValues p{};
  p.x = {0.25, 0.5};
  p.u = {1, 2, 3};
  p.N = {4, 5, 6};
  p.Q = {7, 8};
  p.t1 = Eigen::Vector3d::UnitX();
  p.gap = 0.125;
  p.pressure = 9;
  return p;
}

computation::Result some_result(bool has_obstacle) {
  computation::Result result{.has_obstacle = has_obstacle, .ranks = 2, .warnings = {"doubtful"}, .peak_memory = 1024};
  result.summary.energy = {.membrane = 1.0 / 3, .bending = 2e-17, .shear = 1e300};
  result.summary.reaction.force = {0, 0, 5};
  result.summary.obstacles = {{.name = "table",
                               .reaction = result.summary.reaction,
                               .area = 2,
                               .nodes = 7,
                               .zones = std::vector<solution::ContactZone>(1)}};
  result.certificate.min_gap_between = -1e-5;
  result.summary.is_admissible_wanted = true;
  result.summary.support_reactions = {{.boundary = "rim", .reaction = {.force = {0, 0, 2}}, .nodes = 3}};
  result.summary.point_reactions = {{.at = {0.25, 1}, .force = {1e-9, 0, -2}}};
  result.summary.corner_reactions = {{.boundaries = {"left", "rim"}, .at = {0, 1}, .reaction = {.force = {0, 0, 1}}}};
  result.singular_places = {{.what = "corner", .at = {0, 1}, .radius = 0.1}};
  result.layers = {{.region = "web", .layer = 2, .angle = 45, .component = "12", .most = {.stress = 3}}};
  result.summary.foundations = {{.name = "soil", .reaction = {.force = {0, 0, 4}}, .energy = 0.5},
                                {.name = "prop", .is_spring = true, .reaction = {.force = {0, 0, 1}}, .energy = 0.25}};
  result.summary.body_reactions = {{.name = "plate", .rotation = {0, 0.5, 0}, .reaction = {.force = {0, 0, 3}}}};
  result.estimates = {.cells = {1e-6}, .energy_norm_squared = 1e-6};
  result.estimates->geometry = {.largest = 1e-6, .judged_share = 1};
  result.estimates->goals = {{.name = "energy", .unit = "J", .value = 2, .estimate = -0.25, .contact_edge = 0.5}};
  result.probes = {{"a point", some_point()}};
  result.model =
      computation::ModelCheck{.quantities = {{.name = "energy", .unit = "J", .linear = 3, .finite = 2, .least = 1e-9}}};
  result.modes = {{.kind = computation::Mode::Kind::buckling, .value = 4},
                  {.kind = computation::Mode::Kind::vibration, .value = 9}};
  result.levels.push_back(
      {.cells = 3'000'000'000, .history = {{.active = 7, .safeguarded = true}}, .seconds = {.mesh = 2, .assembly = 3}});
  result.history.push_back({.step = "press",
                            .factors = {.time = 1},
                            .level = result.levels.back(),
                            .summary = result.summary,
                            .probes = result.probes});
  result.history.back().level.goals = {{.name = "energy", .value = 2, .error = 0.25, .tolerance = 1e-3, .scale = 2}};
  return result;
}

Json some_json(bool has_obstacle = true) {
  return results_json(some_result(has_obstacle),
                      {.title = "A case", .settings = {{"mesh", {{"degree", 2}}}}, .files = {"a.vtu"}});
}

TEST(Results, have_every_key_that_the_documentation_promises) {
  const Json json = some_json();
  for (const char* key : {"title",           "status",          "status_text",
                          "energy",          "energy_parts",    "load_work",
                          "loads",           "reaction",        "support_reaction",
                          "contact",         "probes",          "certificate",
                          "levels",          "memory",          "supports",
                          "stress",          "obstacles",       "point_supports",
                          "rigid_bodies",    "ranks",           "settings",
                          "versions",        "files",           "fields",
                          "corner_supports", "singular_places", "units",
                          "estimates",       "layers"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["point_supports"],
            Json::parse(R"([{"at": [0.25, 1.0], "position": [0.0, 0.0, 0.0], "force": [1e-9, 0.0, -2.0]}])"));
  EXPECT_EQ(json["rigid_bodies"][0]["rotation"], Json::parse("[0.0, 0.5, 0.0]"));
  EXPECT_EQ(json["rigid_bodies"][0]["reaction"]["force"], Json::parse("[0.0, 0.0, 3.0]"));
  for (const char* key : {"area", "nodes", "min_gap", "max_penetration_between_nodes", "max_pressure"})
    EXPECT_TRUE(json["contact"].contains(key)) << key;
  for (const char* key : {"x", "position", "u", "r", "gap", "eta", "contact", "N", "M", "Q", "frame", "thickness"})
    EXPECT_TRUE(json["probes"]["a point"].contains(key)) << key;
  for (const char* key : {"cells", "nodes", "unknowns", "active", "iterations", "factorisations", "status", "energy",
                          "reaction", "min_gap", "linear_residual", "seconds", "history"})
    EXPECT_TRUE(json["levels"][0].contains(key)) << key;
}

TEST(Results, compare_the_linear_model_and_have_the_modes) {
  const Json json = some_json();
  EXPECT_EQ(json["linearity"]["status"], "solved");
  EXPECT_EQ(json["linearity"]["difference"], Json(0.5));
  EXPECT_EQ(json["linearity"]["quantities"][0]["finite"], Json(2.0));
  EXPECT_EQ(json["modes"][0]["name"], "buckling_1");
  EXPECT_EQ(json["modes"][0]["load_factor"], Json(4.0));
  EXPECT_NEAR(json["modes"][1]["frequency"].get<double>(), 3 / (2 * M_PI), 1e-15);
  EXPECT_EQ(json["modes"][1]["load_factor"], Json(nullptr));
}

TEST(Results, tell_the_estimated_error_of_what_was_asked_for) {
  const Json goal = some_json()["estimates"]["goals"][0];
  EXPECT_EQ(goal["name"], Json("energy"));
  EXPECT_EQ(goal["difference"], Json(-0.25));
  EXPECT_EQ(goal["error"], Json(0.75));
  EXPECT_EQ(goal["corrected"], Json(1.75));
  EXPECT_TRUE(goal["at_higher_degree"].is_null());
  EXPECT_TRUE(goal["tolerance"].is_null());
  computation::Result asked = some_result(true);
  asked.estimates->goals[0].tolerance = 1e-3;
  asked.estimates->goals[0].at_higher_degree = 2.5;
  const Json known = results_json(asked, {})["estimates"]["goals"][0];
  EXPECT_EQ(known["tolerance"], Json(1e-3));
  EXPECT_EQ(known["at_higher_degree"], Json(2.5));
  EXPECT_EQ(known["corrected"], Json(2.5));
  computation::Result none = some_result(true);
  none.estimates.reset();
  EXPECT_TRUE(results_json(none, {})["estimates"].is_null());
}

TEST(Results, list_the_warnings_in_words) {
  EXPECT_EQ(some_json()["warnings"], Json({"doubtful"}));
  computation::Result none = some_result(true);
  none.warnings.clear();
  EXPECT_EQ(results_json(none, {})["warnings"], Json::array());
}

TEST(Results, hold_every_member_of_the_certificate) {
  EXPECT_EQ(some_json()["certificate"].size(), sizeof(certificate::Certificate) / sizeof(double));
}

TEST(Results, read_back_give_the_same_numbers_to_the_last_digit) {
  const Json json = some_json();
  const Json back = Json::parse(json.dump(2));
  EXPECT_EQ(back, json);
  EXPECT_EQ(back["energy_parts"]["membrane"].get<double>(), 1.0 / 3);
  EXPECT_EQ(back["energy_parts"]["bending"].get<double>(), 2e-17);
  EXPECT_EQ(back["levels"][0]["cells"].get<std::int64_t>(), 3'000'000'000);
  EXPECT_EQ(back["memory"]["peak_bytes"], Json(1024));
}

TEST(Results, of_a_probe_are_numbers_and_arrays_as_the_table_says) {
  const Json probe = some_json()["probes"]["a point"];
  EXPECT_EQ(probe["x"], Json({0.25, 0.5}));
  EXPECT_EQ(probe["u"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(probe["N"], Json({4.0, 5.0, 6.0}));
  EXPECT_EQ(probe["Q"], Json({7.0, 8.0}));
  EXPECT_EQ(probe["gap"], Json(0.125));
  EXPECT_EQ(probe["eta"], Json(9.0));
  EXPECT_EQ(probe["frame"]["t1"], Json({1.0, 0.0, 0.0}));
}

TEST(Results, without_obstacle_have_null_for_contact) {
  const Json json = some_json(false);
  EXPECT_TRUE(json["contact"].is_null());
  for (const char* key : {"gap", "eta", "contact"}) EXPECT_TRUE(json["probes"]["a point"][key].is_null()) << key;
  for (const Json& field : json["fields"]) EXPECT_NE(field["key"], "gap");
}

TEST(Results, that_are_not_finite_are_null) {
  computation::Result result = some_result(true);
  result.certificate.min_gap_between = infinity;
  result.certificate.stationarity = nan;
  result.probes[0].values.u[1] = nan;
  const Json json = results_json(result, {});
  EXPECT_TRUE(json["certificate"]["min_gap_between"].is_null());
  EXPECT_TRUE(json["certificate"]["stationarity"].is_null());
  EXPECT_EQ(json["probes"]["a point"]["u"], Json({1.0, nullptr, 3.0}));
}

TEST(Results, penetration_is_the_negative_part_of_the_gap_between_nodes) {
  computation::Result result = some_result(true);
  const auto penetration = [&](double min_gap_between) {
    result.certificate.min_gap_between = min_gap_between;
    return results_json(result, {})["contact"]["max_penetration_between_nodes"];
  };
  EXPECT_EQ(penetration(-1e-5), Json(1e-5));
  EXPECT_EQ(penetration(1e-5), Json(0.0));
  EXPECT_EQ(penetration(infinity), Json(0.0)) << "no cell is near the obstacle";
  EXPECT_TRUE(penetration(nan).is_null());
}

/// The paths of all numbers, texts and short arrays of numbers. Entries of lists of objects and names of probes become
/// '*'.
void collect(const Json& json, const std::string& path, std::map<std::string, bool>& paths) {
  if (json.is_object())
    for (const auto& [key, value] : json.items())
      collect(value, path + "/" + (path.ends_with("/probes") ? "*" : key), paths);
  else if (json.is_array() && !json.empty() && json[0].is_object())
    for (const Json& value : json) collect(value, path + "/*", paths);
  else
    paths[path.substr(1)] = json.is_number() || (json.is_array() && !json.empty() && json[0].is_number());
}

TEST(Results, state_a_unit_for_every_number) {
  Json json = some_json();
  const Json units = json["units"];
  for (const char* part : {"settings", "versions", "files", "fields", "units", "title", "warnings"}) json.erase(part);
  std::map<std::string, bool> paths;
  collect(json, "", paths);
  for (const auto& [path, is_number] : paths) EXPECT_TRUE(units.contains(path) || !is_number) << path;
  for (const auto& [path, unit] : units.items()) EXPECT_TRUE(paths.contains(path)) << path;
}

TEST(Results, name_the_version_of_the_build) {
  EXPECT_EQ(version, PLASTRON_BUILD_VERSION);
  EXPECT_EQ(some_json()["versions"]["plastron"], Json(version));
}

TEST(Results, are_written_by_rank_0_as_one_valid_file) {
  const ScratchDirectory scratch("results");
  const Provenance provenance{.title = "not UTF-8: \xff", .settings = {{"a", 1}}, .files = {}};
  AtomicFiles files(MPI_COMM_WORLD);
  add_results(some_result(true), provenance, scratch.path, files);
  files.commit();
  const Json json = Json::parse(text_of(scratch.path / "results.json"));
  EXPECT_EQ(json["settings"]["a"], Json(1));
  EXPECT_THAT(scratch.names(), testing::UnorderedElementsAre("results.json"));
}

}  // namespace

}  // namespace plastron::io
