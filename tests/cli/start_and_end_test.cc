// The start and the end of the program: it answers at once if there is nothing to compute, and keeps its results if it is
// interrupted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "cli/program.hpp"

namespace plastron::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string strip(int refinements, const std::string& title = "Pressed strip", const std::string& more = "") {
  return "title = \"" + title + R"("
[shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { rectangle = { to = [1, 0.125], cells = [8, 1] } }
chart = ["x", "y", "0.035"]
[[support]]
boundary = "left"
fix = ["u", "r"]
[[support]]
boundary = "right"
fix = ["u", "r"]
[[load]]
force = [0, 0, -4e-3]
[[obstacle]]
half_space = { point = [0, 0, 0], normal = [0, 0, 1] }
[mesh]
degree = 2
refinements = )" +
         std::to_string(refinements) + "\n" + more;
}

nlohmann::json results_in(const fs::path& directory) {
  return nlohmann::json::parse(text_of(directory / "results.json"));
}

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto characters = std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}

// ---- start -------------------------------------------------------------------------------------------------------------

/// The machine may be busy: takes the fastest of several tries.
double fastest(const std::vector<std::string>& arguments, const fs::path& directory) {
  double seconds = 1e9;
  for (int i = 0; i < 10 && seconds > 0.1; ++i) seconds = std::min(seconds, plastron(arguments, directory).seconds);
  return seconds;
}

TEST(Start, of_what_computes_nothing_takes_a_fifth_of_a_second) {
  const Scratch scratch;
  scratch.write("syntax.toml", "title = [");
  scratch.write("wrong.toml", strip(0) + "[solver]\nmax_iterations = -1\n");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--version"},
                                                    {"--help"},
                                                    {"run", "--help"},
                                                    {},
                                                    {"fly"},
                                                    {"run"},
                                                    {"check", "a", "b"},
                                                    {"check", "no-such.toml"},
                                                    {"check", "syntax.toml"},
                                                    {"check", "wrong.toml"},
                                                    {"run", "syntax.toml", "-o", "X"}})
    EXPECT_LT(fastest(arguments, scratch.path), 0.2) << testing::PrintToString(arguments);
}

TEST(Start, of_several_processes_answers_once) {
  const Scratch scratch;
  scratch.write("syntax.toml", "title = [");
  const std::string job = MPIEXEC " --oversubscribe -n 3 $PLASTRON ";
  for (const std::string arguments : {"check syntax.toml", "fly", "check no-such.toml"}) {
    const Outcome outcome = shell(job + arguments, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    const bool is_case = arguments.starts_with("check");
    const std::string words = is_case ? ".toml" : "fly";
    const auto first = outcome.output.find(is_case ? ": error:" : words);
    ASSERT_NE(first, std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find(is_case ? ": error:" : words, first + 1), std::string::npos) << outcome.output;
  }
  EXPECT_EQ(shell(job + "--version", scratch.path).output, PLASTRON_BUILD_VERSION "\n");
}

// The processes of one job get different files here, as on several machines of which one does not see the file.
TEST(Job, whose_processes_cannot_all_read_the_case_ends_with_one_error) {
  const Scratch scratch;
  scratch.write("case.toml", strip(0));
  // Without the variables that make processes outside mpirun start fast.
  const std::string job = "unset OMPI_MCA_ess_singleton_isolated OMPI_MCA_pml OMPI_MCA_btl; " MPIEXEC
                          " --oversubscribe -n 2 $PLASTRON-solver run case.toml -o A -q : -n 1 $PLASTRON-solver run ";
  const Outcome outcome = shell(job + "no-such.toml -o A -q", scratch.path);
  EXPECT_FALSE(outcome.timed_out);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  const auto first = outcome.output.find("no-such.toml");
  ASSERT_NE(first, std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("no-such.toml: error", first + 1), std::string::npos) << outcome.output;
}

// A shared folder would be removed by the program that ends first while another one starts.
TEST(Start, of_a_program_alone_makes_no_folder_for_mpi) {
  const Scratch scratch;
  scratch.write("case.toml", strip(0));
  const std::string nowhere = "unset OMPI_MCA_orte_tmpdir_base; export TMPDIR=/dev/null/none; ";
  for (const std::string command : {"check case.toml", "run case.toml -o A -q"}) {
    const Outcome outcome = shell(nowhere + "$PLASTRON " + command, scratch.path);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}

TEST(Output, may_be_called_out_and_threads_may_be_given) {
  const Scratch scratch;
  scratch.write("case.toml", strip(0));
  for (const std::string option : {"--out", "--output", "-o"}) {
    const Outcome outcome = plastron({"run", "case.toml", option, "at" + option, "--threads", "2", "-q"}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_TRUE(fs::exists(scratch.path / ("at" + option) / "results.json"));
  }
  EXPECT_EQ(plastron({"run", "case.toml", "-o", "X", "--threads", "-1"}, scratch.path).exit_code, 2);
}

// ---- what is printed ---------------------------------------------------------------------------------------------------

TEST(Lines, fit_a_page) {
  const Scratch scratch;
  scratch.write("case.toml", strip(1, std::string(150, 'T'), "[[probe]]\nname = \"middle\"\nat = [0.5, 0.06]\n"));
  scratch.write("wrong.toml", strip(0) + "[solver]\nmax_steps = " + std::string(500, '1') + "\n[mush]\na = 1\n");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"run", "--help"},
                                                    {"study", "--help"},
                                                    {"compare", "--help"},
                                                    {"check", "case.toml"},
                                                    {"run", "case.toml", "-o", "out"},
                                                    {"check", "wrong.toml"}}) {
    const std::string output = plastron(arguments, scratch.path).output;
    EXPECT_LE(longest_line(output), 120u) << output;
    EXPECT_GT(output.size(), 20u);
  }
}

TEST(ControlCharacters, of_titles_paths_and_values_never_reach_the_terminal) {
  const Scratch scratch;
  const std::string evil = "\\u001b]0;owned\\u0007\\u001b[2J\\u009b31m\\u007f\\r\\n";
  scratch.write("case.toml", strip(0, evil));
  scratch.write("value.toml", strip(0) + "[solver]\n\"" + evil + "\" = 1\n");
  scratch.write("\x1b[31m.toml", "a = 1");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"check", "case.toml"},
                                                    {"run", "case.toml", "-o", "out"},
                                                    {"check", "value.toml"},
                                                    {"check", "\x1b[31m.toml"},
                                                    {"check", "no\x1b[31m"},
                                                    {"\x1b[31m"},
                                                    {"run", "case.toml", "-o", "case.toml/\x1b[1m"}}) {
    const Outcome outcome = plastron(arguments, scratch.path);
    EXPECT_NE(outcome.output, "");
    EXPECT_GE(outcome.exit_code, 0);
    for (const std::string bad : {"\x1b", "\x07", "\x7f", "\r", "\xC2\x9B"})
      EXPECT_THAT(outcome.output, Not(HasSubstr(bad))) << testing::PrintToString(arguments);
  }
}

// A solvable case with a warning.
const std::string strongly_bent = R"toml([shell]
E = 1.0
nu = 0.3
thickness = 0.05
[geometry]
domain = { rectangle = { to = [0.05, 0.05], cells = [1, 1] } }
chart = ["0.07*sin(x/0.07)", "y", "0.07*(1 - cos(x/0.07))"]
[mesh]
refinements = 0
[[support]]
boundary = "left"
fix = ["u", "r"]
[[load]]
force = [0, 0, -1e-6]
)toml";

TEST(Warnings, of_the_examination_stand_in_the_results_too) {
  const Scratch scratch;
  scratch.write("case.toml", strongly_bent);
  const Outcome outcome = plastron({"run", "case.toml", "-o", "out"}, scratch.path);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  ASSERT_THAT(outcome.output, HasSubstr("warning: "));
  const auto warnings = results_in(scratch.path / "out").at("warnings");
  ASSERT_EQ(warnings.size(), 2u) << outcome.output;
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr("thick"));
  EXPECT_THAT(warnings[1].get<std::string>(), HasSubstr("kappa"));
}

/// mpirun forwards both streams in any order.
std::vector<std::string> sorted_lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::ranges::sort(lines);
  return lines;
}

TEST(Examination, by_one_process_for_several_says_the_same) {
  const Scratch scratch;
  scratch.write("bent.toml", strongly_bent);
  const std::string rectangle = "domain = { rectangle = { to = [0.05, 0.05], cells = [1, 1] } }",
                    with_mesh = "domain = { mesh = \"plate.msh\" }";
  std::string imported = strongly_bent;
  imported.replace(imported.find(rectangle), rectangle.size(), with_mesh);
  scratch.write("imported.toml", imported);
  scratch.write(
      "plate.msh",
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 1 \"left\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n"
      "2 0.05 0 0\n3 0.05 0.05 0\n4 0 0.05 0\n$EndNodes\n$Elements\n2\n1 1 2 1 1 4 1\n2 3 0 1 2 3 4\n$EndElements\n");
  const std::string job = "unset OMPI_MCA_ess_singleton_isolated OMPI_MCA_pml OMPI_MCA_btl; " MPIEXEC
                          " --oversubscribe -n 3 $PLASTRON check ";
  for (const std::string name : {"bent.toml", "imported.toml"}) {
    const Outcome alone = plastron({"check", name}, scratch.path), together = shell(job + name, scratch.path);
    EXPECT_FALSE(together.timed_out);
    EXPECT_EQ(alone.exit_code, 0) << alone.output;
    EXPECT_EQ(together.exit_code, 0) << together.output;
    EXPECT_THAT(alone.output, HasSubstr("kappa"));
    EXPECT_EQ(sorted_lines(together.output), sorted_lines(alone.output));
  }
}

// ---- closed and full streams -------------------------------------------------------------------------------------------

TEST(Results, are_written_whoever_reads_what_is_printed) {
  const Scratch scratch;
  scratch.write("case.toml", strip(1));
  int number = 0;
  for (const std::string& line :
       {std::string("$PLASTRON run case.toml -o OUT | head -1; exit ${PIPESTATUS[0]}"),
        std::string("$PLASTRON run case.toml -o OUT | true; exit ${PIPESTATUS[0]}"),
        std::string("$PLASTRON run case.toml -o OUT >&-"), std::string("$PLASTRON run case.toml -o OUT <&- >&- 2>&-"),
        std::string("$PLASTRON run case.toml -o OUT >/dev/full")}) {
    const std::string out = "out" + std::to_string(++number);
    std::string command = line;
    command.replace(command.find("OUT"), 3, out);
    const Outcome outcome = shell(command, scratch.path);
    EXPECT_EQ(outcome.exit_code, 0) << command << "\n" << outcome.output;
    EXPECT_THAT(outcome.output, AllOf(Not(HasSubstr("PETSC")), Not(HasSubstr("MPI"))));
    ASSERT_TRUE(fs::exists(scratch.path / out / "results.json")) << command;
    EXPECT_EQ(results_in(scratch.path / out).at("status"), "solved");
    EXPECT_THAT(text_of(scratch.path / out / "solution.vtu"), HasSubstr("</VTKFile>"));
  }
}

TEST(Results, that_the_disk_refuses_are_a_message) {
  const Scratch scratch;
  scratch.write("case.toml", strip(1));
  const Outcome outcome = shell("trap '' XFSZ; ulimit -f 300; $PLASTRON run case.toml -o out", scratch.path);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("cannot write"), HasSubstr("--output"), Not(HasSubstr("internal error"))));
  EXPECT_FALSE(fs::exists(scratch.path / "out/results.json"));
}

TEST(Results, that_cannot_be_written_are_found_out_before_anything_is_solved) {
  const Scratch scratch;
  scratch.write("case.toml", strip(0));
  scratch.write("file", "precious");
  for (const std::string directory : {"/proc/self/nowhere", "file/below", "file", "/dev/null"}) {
    const Outcome outcome = plastron({"run", "case.toml", "-o", directory}, scratch.path);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("results cannot be written here"), Not(HasSubstr("unknowns"))));
  }
  EXPECT_EQ(text_of(scratch.path / "file"), "precious");
}

// ---- interruptions -----------------------------------------------------------------------------------------------------

/// Waits until a run has printed that many meshes; false if it ends earlier.
bool has_finished_a_mesh(Running& run) {
  for (int i = 0; i < 4000 && run.is_alive(); ++i) {
    if (const std::string text = run.output(); std::ranges::count(text, '\n') >= 4) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST(Modes, end_with_the_time_and_keep_the_solution) {
  const Scratch scratch;
  const std::string text = strip(0);
  scratch.write("case.toml", text.substr(0, text.find("[mesh]")) + "[accuracy]\nenergy = 0.4\nmax_seconds = 1e-9\n");
  const Outcome outcome = plastron({"modes", "case.toml", "-o", "out", "--buckling", "2"}, scratch.path);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  const auto results = results_in(scratch.path / "out");
  EXPECT_THAT(results.at("status_text").get<std::string>(),
              HasSubstr("max_seconds = 1e-09 was over before the buckling loads were found"));
  EXPECT_EQ(results.at("status"), "accuracy_not_reached");
  EXPECT_TRUE(results.at("modes").empty());
  EXPECT_GT(results.at("energy").get<double>(), 0);
}

TEST(Interruption, leaves_the_results_of_the_last_mesh_that_was_finished) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Scratch scratch;
    scratch.write("case.toml", strip(9));
    Running run({"run", "case.toml", "-o", "out"}, scratch.path);
    ASSERT_TRUE(has_finished_a_mesh(run)) << run.output();
    run.send(signal);
    EXPECT_EQ(run.end(60), 3) << run.output();
    EXPECT_THAT(run.output(), HasSubstr("interrupted"));
    const auto results = results_in(scratch.path / "out");
    EXPECT_EQ(results.at("status"), "interrupted");
    EXPECT_GE(results.at("levels").size(), 1u);
    EXPECT_LT(results.at("levels").size(), 10u);
    EXPECT_GT(results.at("energy").get<double>(), 0);
    EXPECT_THAT(text_of(scratch.path / "out/solution.vtu"), HasSubstr("</VTKFile>"));
  }
}

TEST(Interruption, that_is_repeated_ends_the_program_at_once) {
  const Scratch scratch;
  scratch.write("case.toml", strip(9));
  Running run({"run", "case.toml", "-o", "out"}, scratch.path);
  ASSERT_TRUE(has_finished_a_mesh(run)) << run.output();
  run.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  run.send(SIGINT);
  const auto end = run.end(30);
  ASSERT_TRUE(end);
  // The program may have answered the first signal before the second came.
  EXPECT_TRUE(*end == -SIGINT || *end == 3) << *end;
}

// ---- memory ------------------------------------------------------------------------------------------------------------

TEST(Memory, that_does_not_suffice_is_a_message) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer reserves more memory than the limit leaves";
#endif
  const Scratch scratch;
  scratch.write("case.toml", strip(9));
  for (const int megabytes : {100, 400, 900}) {
    const Outcome outcome =
        shell("ulimit -v " + std::to_string(megabytes * 1024) + "; $PLASTRON run case.toml -o out", scratch.path, 60);
    EXPECT_FALSE(outcome.timed_out) << megabytes;
    EXPECT_EQ(outcome.exit_code, 4) << megabytes << "\n" << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("memory")) << megabytes;
    EXPECT_FALSE(fs::exists(scratch.path / "out/results.json"));
  }
}

}  // namespace
}  // namespace plastron::cli
