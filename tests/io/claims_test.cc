// The claims of results.json beside recomputed values: no number that follows from the solution can be changed
// unnoticed.
#include <plastron/io/claims.hpp>
#include <plastron/workflow/output.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>

#include <functional>

namespace plastron::io {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using workflow::write_output;

std::vector<std::string> disagreeing(const std::vector<Comparison>& all) {
  std::vector<std::string> paths;
  for (const Comparison& c : all)
    if (!c.agrees) paths.push_back(c.path);
  return paths;
}

const computation::Result& solved_plate() {
  static const computation::Result result =
      computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  return result;
}

/// Calls visit(path, number) for the floating-point numbers below.
void for_numbers(Json& json, const std::string& path, const std::function<void(const std::string&, Json&)>& visit) {
  if (json.is_object()) {
    for (auto& [name, value] : json.items()) for_numbers(value, path + "." + name, visit);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) for_numbers(json[i], path + "[" + std::to_string(i) + "]", visit);
  } else if (json.is_number()) {
    visit(path, json);
  }
}

TEST(Claims, of_the_results_themselves_agree) {
  const auto all = compare_numbers(results_json(solved_plate(), {}), solved_plate());
  EXPECT_GT(all.size(), 100U);
  EXPECT_THAT(disagreeing(all), testing::IsEmpty());
}

TEST(Claims, that_are_changed_are_named) {
  Json claimed = results_json(solved_plate(), {});
  int changed = 0;
  for (const char* part : {"energy", "energy_parts", "load_work", "loads", "reaction", "support_reaction", "size",
                           "tangency", "contact", "obstacles", "probes", "certificate", "stress", "supports"})
    for_numbers(claimed[part], part, [&](const std::string& path, Json& number) {
      if (path.find("_direction") != std::string::npos || path == "stress.error") return;  // without an error bound
      const Json before = number;
      if (number.is_number_integer())
        number = number.get<int>() + 1;
      else
        number = 1.001 * number.get<double>() + (number.get<double>() == 0 ? 1e6 : 0);
      // A number that is rounding may have any value of that size.
      const bool is_rounding = before.is_number_float() && std::abs(number.get<double>()) < 1e-7;
      if (!is_rounding) {
        EXPECT_THAT(disagreeing(compare_numbers(claimed, solved_plate())), ElementsAre(path));
      }
      changed += is_rounding ? 0 : 1;
      number = before;
    });
  EXPECT_GT(changed, 60);
}

TEST(Claims, that_are_missing_or_of_another_kind_are_named) {
  Json claimed = results_json(solved_plate(), {});
  claimed.erase("energy");
  claimed["load_work"] = "much";
  claimed["reaction"] = 3;
  claimed["formulation"] = "mixed";
  claimed["certificate_limits"]["stationarity"]["holds"] = false;
  claimed["certificate_limits"]["moment_balance"]["at_most"] = 0.5;
  claimed["levels"] = Json::array();
  EXPECT_THAT(
      disagreeing(compare_numbers(claimed, solved_plate())),
      testing::IsSupersetOf({"formulation", "energy", "load_work", "reaction.force", "reaction.moment",
                             "certificate_limits.stationarity.holds", "certificate_limits.moment_balance.at_most",
                             "levels[last].cells", "levels[last].energy"}));
  EXPECT_EQ(disagreeing(compare_numbers(Json(7), solved_plate())).empty(), false);
}

TEST(Claims, of_settings_are_compared_where_both_have_them) {
  const Json of_case{{"mesh", {{"degree", 2}, {"new key", 1}}}, {"load", {{{"force", {0, 0, -1.5}}}}}};
  Json claimed{{"mesh", {{"degree", 2}}}, {"load", {{{"force", {0, 0, -1.5}}}}}};
  EXPECT_THAT(disagreeing(differing_settings(claimed, of_case)), testing::IsEmpty());
  claimed["mesh"]["degree"] = 3;
  claimed["load"][0]["force"][2] = -1.6;
  EXPECT_THAT(disagreeing(differing_settings(claimed, of_case)),
              ElementsAre("settings.mesh.degree", "settings.load[0].force[2]"));
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  if (world_rank() == 0) std::ofstream(path, std::ios::binary) << text;
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(Claims, tell_which_files_have_changed) {
  const ScratchDirectory scratch("sources");
  write_text(scratch.path / "plate.msh", "nodes");
  const CaseSource source =
      case_source(scratch.path / "case.toml", "title = 1\n", {{"plate.msh", scratch.path / "plate.msh"}});
  write_output(solved_plate(), {.title = "", .settings = {}, .files = {}, .source = source}, scratch.path, "solution",
               MPI_COMM_WORLD);
  const Claims claims = read_claims(scratch.path, MPI_COMM_WORLD);
  EXPECT_EQ(claims.status, "solved");
  EXPECT_EQ(claims.solution, scratch.path / "solution.plastron");
  EXPECT_EQ(text_of(claims.case_copy), "title = 1\n");
  EXPECT_EQ(claims.case_folder, scratch.path);
  EXPECT_NO_THROW(check_sources(claims, scratch.path, MPI_COMM_WORLD));
  const auto words = [&] {
    std::string text;
    try {
      check_sources(claims, scratch.path, MPI_COMM_WORLD);
    } catch (const UnusableResults& error) {
      text = error.what();
    }
    MPI_Barrier(MPI_COMM_WORLD);
    return text;
  };
  write_text(scratch.path / "plate.msh", "nodeS");
  EXPECT_THAT(words(), testing::AllOf(HasSubstr("\"plate.msh\""), HasSubstr("has changed")));
  EXPECT_THAT(words(), testing::Not(HasSubstr("copy")));
  write_text(scratch.path / "solution.case.toml", "title = 2\n");
  EXPECT_THAT(words(), testing::AllOf(HasSubstr("plate.msh"), HasSubstr("copy of the case")));
  if (world_rank() == 0) std::filesystem::remove(scratch.path / "plate.msh");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THAT(words(), HasSubstr("no such file"));
}

TEST(Claims, that_cannot_be_read_are_refused_in_words) {
  const ScratchDirectory scratch("unusable");
  const auto words = [&] {
    std::string text;
    try {
      read_claims(scratch.path, MPI_COMM_WORLD);
    } catch (const UnusableResults& error) {
      text = error.what();
    }
    MPI_Barrier(MPI_COMM_WORLD);
    return text;
  };
  EXPECT_THAT(words(), HasSubstr("no results.json"));
  const std::vector<std::pair<const char*, const char*>> wrong{
      {"", "cannot be read"},
      {"{\"status\":", "not JSON"},
      {"7", "status"},
      {R"({"status": 1})", "status"},
      {R"({"status": "solved"})", "verification"},
      {R"({"status": "solved", "verification": {"case": null}})", "case"},
      {R"({"status": "solved", "verification": {"case": {"copy": "../x"}}})", "copy"},
      {R"({"status": "solved", "verification": {"case": {"copy": "x", "bytes": -1}}})", "bytes"},
      {R"({"status": "solved", "verification": {"case": {"copy": "x", "bytes": 1, "sha256": "h", "path": "p", "files": 3}}})",
       "files"}};
  for (const auto& [text, named] : wrong) {
    write_text(scratch.path / "results.json", text);
    EXPECT_THAT(words(), HasSubstr(named)) << text;
  }
}

TEST(Checksum, is_sha_256) {
  // The examples of FIPS 180.
  EXPECT_EQ(checksum_of_text("").hash, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(checksum_of_text("abc").hash, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(checksum_of_text("abc").bytes, 3U);
}

}  // namespace

}  // namespace plastron::io
