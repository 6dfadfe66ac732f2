// The way of a case from its file to verified results. An error that the user can mend becomes RefusedCase with the same words.
// Other exceptions pass unchanged. A run that keeps nothing leaves the directory of results as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/computation/sensitivity.hpp>
#include <plastron/energy/loads.hpp>
#include <plastron/geometry/given_function.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/workflow/output_directory.hpp>
#include <plastron/workflow/read.hpp>
#include <plastron/workflow/solve.hpp>
#include <plastron/workflow/verify.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <new>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <utility>
#include <vector>

#include "io/scratch_directory.hpp"

namespace plastron::workflow::workflow_test {
namespace {

using examination::Finding;
using examination::Severity;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string shell = "[shell]\nE = 2.0\nnu = 0.25\nthickness = 0.05\n";
const std::string square =
    "[geometry]\ndomain = { rectangle = { from = [0, 0], to = [1, 1] } }\nchart = [\"x\", \"y\", \"0.3\"]\n";
const std::string good = shell + square +
                         "[[support]]\nboundary = \"left\"\nfix = [\"u\", \"r\"]\n[[load]]\nforce = [0, 0, -1e-4]\n"
                         "[mesh]\ndegree = 2\nrefinements = 0\n";

config::Case parsed(const std::string& text) { return config::parse_case(text, "case.toml"); }
config::Case read(const std::string& text) {
  return read_together([&] { return parsed(text); }, MPI_COMM_WORLD);
}

/// The text of the exception of this very type that `work` throws.
template <class Exception>
std::string thrown(const std::function<void()>& work) {
  try {
    work();
  } catch (const Exception& error) {
    EXPECT_EQ(typeid(error), typeid(Exception)) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(Refusing, TakesErrorsOfTheCaseAndKeepsTheirWords) {
  const std::vector<std::function<void()>> of_the_case{
      [] { throw mesh::DomainError("word 1"); },       [] { throw assembly::SupportError("word 1"); },
      [] { throw obstacle::ObstacleError("word 1"); }, [] { throw energy::LoadError("word 1"); },
      [] { throw geometry::FunctionError("word 1"); }, [] { throw computation::SensitivityError("word 1"); }};
  for (const auto& work : of_the_case) EXPECT_EQ(thrown<RefusedCase>([&] { refusing(work); }), "error: word 1\n");
  refusing([] {});  // nothing is wrong
}

TEST(Refusing, LeavesTheProgramsOwnErrors) {
  EXPECT_EQ(thrown<std::runtime_error>([] { refusing([] { throw std::runtime_error("a"); }); }), "a");
  EXPECT_EQ(thrown<std::logic_error>([] { refusing([] { throw std::logic_error("b"); }); }), "b");
  EXPECT_EQ(thrown<std::invalid_argument>([] { refusing([] { throw std::invalid_argument("c"); }); }), "c");
  EXPECT_EQ(thrown<io::WriteError>([] { refusing([] { throw io::WriteError("d"); }); }), "d");
  EXPECT_EQ(thrown<RefusedCase>([] { refusing([] { throw RefusedCase("e"); }); }), "e");  // it is printed already
  thrown<std::bad_alloc>([] { refusing([] { throw std::bad_alloc(); }); });
}

// Each line of a good case is left out, doubled, damaged or followed by a comment in turn. What the parser refuses, the workflow refuses in the same words; what
// the parser takes, the workflow takes.
TEST(ReadTogether, RefusesWhatTheParserRefuses) {
  std::vector<std::string> lines;
  std::string line;
  for (std::istringstream text(good); std::getline(text, line);) lines.push_back(line + "\n");
  int refused = 0, taken = 0;
  for (std::size_t at = 0; at < lines.size(); ++at)
    for (const std::string& other :
         {std::string(), lines[at] + lines[at], "x" + lines[at], lines[at] + "?\n", lines[at] + "# why\n"}) {
      std::string text;
      for (std::size_t i = 0; i < lines.size(); ++i) text += i == at ? other : lines[i];
      try {
        (void)parsed(text);
      } catch (const config::CaseErrors& errors) {
        ++refused;
        EXPECT_EQ(thrown<RefusedCase>([&] { (void)read(text); }), errors.format());
        continue;
      }
      ++taken;
      EXPECT_EQ(read(text).text, text);
    }
  EXPECT_GT(refused, 30);
  EXPECT_GE(taken, static_cast<int>(lines.size()));  // a comment more changes nothing
}

TEST(ReadTogether, LeavesOtherErrorsAndDoesWhatTheMeshIsNeededFor) {
  const auto throwing = [](const auto& error) {
    return [error] { (void)read_together([&]() -> config::Case { throw error; }, MPI_COMM_WORLD); };
  };
  EXPECT_EQ(thrown<std::logic_error>(throwing(std::logic_error("a"))), "a");
  EXPECT_EQ(thrown<std::runtime_error>(throwing(std::runtime_error("b"))), "b");
  // A plate that stands on a table touches with both faces, and probes in space are located: config alone does neither.
  const std::string standing =
      shell +
      "[geometry]\ndomain = { rectangle = { from = [0, 0], to = [1, 1] } }\nchart = [\"x\", \"0\", \"y\"]\n"
      "[[obstacle]]\nname = \"table\"\nhalf_space = { point = [0, 0, -0.01] }\n";
  EXPECT_EQ(parsed(standing).problem.shell.obstacles.all.size(), 1U);
  EXPECT_EQ(read(standing).problem.shell.obstacles.all.size(), 2U);
  const std::string broken_mesh =
      shell + "[geometry]\ndomain = { mesh = \"no such file.msh\" }\nchart = [\"x\", \"y\", \"0\"]\n";
  const std::string words = thrown<RefusedCase>([&] { (void)read(broken_mesh); });
  EXPECT_THAT(words, HasSubstr("no such file.msh"));
}

// Drawn findings, with every character that a message may have but the one that ends it.
TEST(ExamineTogether, HasTheFindingsOfTheFirstRankWithAllTheirCharacters) {
  std::mt19937 random(1);
  for (int draw = 0; draw < 30; ++draw) {
    std::vector<Finding> given;
    for (std::size_t k = random() % 5; k > 0; --k) {
      std::string text;
      for (std::size_t i = random() % 40; i > 0; --i) text += static_cast<char>(1 + random() % 255);
      given.push_back({static_cast<Severity>(random() % 3), text});
    }
    const auto found = examine_together(
        [&] {
          return io::world_rank() == 0 ? given : std::vector<Finding>{{Severity::error, "of another rank"}};
        },
        MPI_COMM_WORLD);
    ASSERT_EQ(found.size(), given.size());
    for (std::size_t k = 0; k < given.size(); ++k) {
      EXPECT_EQ(found[k].severity, given[k].severity);
      EXPECT_EQ(found[k].text, given[k].text);
    }
  }
  const auto examination = [](const auto& error) {
    return [error] { (void)examine_together([&]() -> std::vector<Finding> { throw error; }, MPI_COMM_WORLD); };
  };
  EXPECT_EQ(thrown<mesh::DomainError>(examination(mesh::DomainError("a"))), "a");
  EXPECT_EQ(thrown<obstacle::ObstacleError>(examination(obstacle::ObstacleError("b"))), "b");
}

TEST(Severities, HaveTheirNames) {
  EXPECT_STREQ(to_string(Severity::error), "error");
  EXPECT_STREQ(to_string(Severity::warning), "warning");
  EXPECT_STREQ(to_string(Severity::note), "note");
}

// One status says that the case itself is wrong. The text has the step, its time and the status in words.
TEST(Refusals, AreThoseOfInfeasibleCasesAlone) {
  int refused = 0;
  for (const contact::Status status : contact::statuses()) refused += is_refused(status) ? 1 : 0;
  EXPECT_EQ(refused, 1);
  EXPECT_TRUE(is_refused(contact::Status::infeasible));
  computation::Result result;
  result.status = contact::Status::infeasible;
  const std::string words = refusal(result);
  EXPECT_EQ(words, computation::status_text(result));
  result.history.emplace_back();
  result.history.back().step = "close";
  result.history.back().factors.time = 1.5;
  EXPECT_EQ(refusal(result), "in step \"close\", at time 1.5: " + computation::status_text(result));
}

std::set<std::string> all_below(const fs::path& path) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(path)) names.insert(fs::relative(entry, path).string());
  return names;
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

TEST(OutputDirectory, IsAsBeforeWhereNothingIsKept) {
  const io::ScratchDirectory scratch("output-directory");
  const fs::path& root = scratch.path;
  fs::create_directory(root / "old");
  write(root / "file", "text");
  const auto before = all_below(root);
  for (const char* name : {"new", "new/deep/deeper", "old", "old/new"}) {
    {
      const OutputDirectory directory(root / name, MPI_COMM_WORLD);
      EXPECT_EQ(directory.obstacle(), "") << name;
      EXPECT_TRUE(fs::is_directory(root / name));
    }
    EXPECT_EQ(all_below(root), before) << name;
  }
  for (const char* name : {"file", "file/below"}) {
    const OutputDirectory directory(root / name, MPI_COMM_WORLD);
    EXPECT_THAT(directory.obstacle(), HasSubstr("file")) << name;
  }
  EXPECT_EQ(all_below(root), before);
  EXPECT_EQ(io::text_of(root / "file"), "text");
  {
    const OutputDirectory directory(root / "kept/deep", MPI_COMM_WORLD);
    write(root / "kept/deep/results", "x");
  }
  EXPECT_TRUE(fs::exists(root / "kept/deep/results"));
}

TEST(OutputDirectory, DoesNotTakeThePlaceOfInputs) {
  const io::ScratchDirectory scratch("output-inputs");
  const fs::path results = scratch.path / "results";
  fs::create_directory(results);
  write(scratch.path / "case.toml", good);
  write(results / "solution.vtu", "an input");
  const fs::path case_file = scratch.path / "case.toml", input = results / "solution.vtu";
  EXPECT_EQ(OutputDirectory(results, {case_file}, MPI_COMM_WORLD).obstacle(), "");
  EXPECT_THAT(OutputDirectory(results, {case_file, input}, MPI_COMM_WORLD).obstacle(), HasSubstr("solution.vtu"));
  EXPECT_EQ(io::text_of(input), "an input");
}

TEST(Inputs, AreTheCaseFileAndTheFilesThatItNames) {
  const io::ScratchDirectory scratch("inputs");
  write(scratch.path / "a.msh", "a");
  write(scratch.path / "case.toml", good);
  config::Case c = parsed(good);
  const fs::path case_file = scratch.path / "case.toml";
  EXPECT_EQ(inputs_of(c, case_file), std::vector<fs::path>{case_file});
  c.files = {{"a.msh", scratch.path / "a.msh"}};
  EXPECT_EQ(inputs_of(c, case_file), (std::vector<fs::path>{case_file, scratch.path / "a.msh"}));
  const io::CaseSource source = source_of(c, case_file, {"shell.nu=0.2"}, MPI_COMM_WORLD);
  EXPECT_EQ(source.text, good);
  EXPECT_EQ(source.settings, std::vector<std::string>{"shell.nu=0.2"});
  ASSERT_EQ(source.files.size(), 1U);
  EXPECT_EQ(source.files[0].name, "a.msh");
  fs::remove(scratch.path / "a.msh");
  EXPECT_THROW((void)source_of(c, case_file, {}, MPI_COMM_WORLD), std::runtime_error);
}

// Results pass their verification as they were written, and fail it with any one number or file changed.
TEST(Results, AreVerifiedAsWrittenAndNotOtherwise) {
  const io::ScratchDirectory scratch("workflow-results");
  const fs::path case_file = scratch.path / "case.toml", directory = scratch.path / "results";
  write(case_file, good);
  const config::Case c = read_together([&] { return config::read_case(case_file); }, MPI_COMM_WORLD);
  workflow::Output files(directory, base_name, MPI_COMM_WORLD, false);
  const std::vector<Finding> findings{{Severity::warning, "first"},
                                      {Severity::note, "a note"},
                                      {Severity::warning, "first"},
                                      {Severity::warning, "last"}};
  const computation::Result result = solve(c, findings, files, MPI_COMM_WORLD, {});
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_EQ(std::ranges::count(result.warnings, "first"), 1);
  EXPECT_EQ(std::ranges::count(result.warnings, "a note"), 0);
  EXPECT_EQ(result.warnings.back(), "last");
  const io::Provenance provenance = provenance_of(c, source_of(c, case_file, {}, MPI_COMM_WORLD));
  EXPECT_EQ(provenance.title, c.title);
  EXPECT_TRUE(provenance.settings == nlohmann::ordered_json(c.effective));
  (void)files.finish(result, provenance);

  const Judgement judgement = verify(directory, {}, MPI_COMM_WORLD);
  EXPECT_THAT(judgement.failures, testing::IsEmpty());
  EXPECT_TRUE(judgement.read_case.has_value());
  EXPECT_GT(judgement.numbers.size(), 30U);
  EXPECT_EQ(judgement.recomputed.result.status, contact::Status::solved);

  const std::string before = io::text_of(directory / "results.json");
  const auto failures_with = [&](const std::function<void(io::Json&)>& change) {
    io::Json json = io::Json::parse(before);
    change(json);
    write(directory / "results.json", json.dump());
    const std::vector<std::string> failures = verify(directory, {}, MPI_COMM_WORLD).failures;
    write(directory / "results.json", before);
    return failures;
  };
  EXPECT_THAT(failures_with([](io::Json& json) { json["energy"] = 2 * json["energy"].get<double>(); }),
              testing::Contains(HasSubstr("energy")));
  EXPECT_THAT(failures_with([](io::Json& json) { json["settings"]["shell"]["nu"] = 0.3; }),
              testing::Contains(HasSubstr("nu")));
  const auto unsolved = failures_with([](io::Json& json) { json["status"] = "cycling"; });
  ASSERT_EQ(unsolved.size(), 1U);
  EXPECT_THAT(unsolved[0], HasSubstr("cycling"));

  write(directory / "results.json", "{");
  EXPECT_THROW((void)verify(directory, {}, MPI_COMM_WORLD), io::UnusableResults);
  write(directory / "results.json", before);
  write(directory / "solution.case.toml", good + " ");
  EXPECT_THROW((void)verify(directory, {}, MPI_COMM_WORLD), io::UnusableResults);
}

}  // namespace
}  // namespace plastron::workflow::workflow_test
