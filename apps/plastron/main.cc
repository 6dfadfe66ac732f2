// plastron: the command line.
#include "commands.hpp"
#include "console.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/assembly/load_vector.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/config/mistakes.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/io/version.hpp>

#include <mpi.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <new>
#include <optional>

namespace plastron::app {

namespace {

/// Runs a command and turns what it throws into a message and an exit code.
ExitCode guarded(const std::function<ExitCode()>& command) {
  try {
    return command();
  } catch (const config::CaseErrors& errors) {
    print_error("{}", errors.format());
    return bad_input;
  } catch (const fem::DomainError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const assembly::SupportError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const assembly::LoadError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  }
  // What follows may have struck one rank alone, so that rank speaks and takes the others down.
  catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: not enough memory; reduce mesh.refinements or mesh.degree, or use more machines\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
  }
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks > 1) MPI_Abort(MPI_COMM_WORLD, internal_error);
  return internal_error;
}

/// Declares `plastron study`: one table of kinds, and options that concern some of them.
CLI::App* add_study(CLI::App& program, StudyCommand& command, std::optional<int>& steps) {
  std::vector<std::string> names;
  std::string footer = "Kinds:\n";
  for (const study::Kind& kind : study::kinds()) {
    names.emplace_back(kind.name);
    footer += fmt::format("  {:<12} {}\n", kind.name, kind.question);
  }
  study::StudyOptions& o = command.options;
  CLI::App* app = program.add_subcommand("study", "Solve a case many times and examine a theorem or a limit with it");
  app->footer(footer);
  app->add_option("KIND", command.kind, "What to examine; see below")->required()->check(CLI::IsMember(names));
  app->add_option("CASE", command.case_file, "Case file (TOML)")->required();
  app->add_option("-o,--output", command.output, "Directory for KIND.json and KIND.svg")->required();
  app->add_flag("-q,--quiet", command.quiet, "Print errors only");
  app->add_option("--reference", o.reference, "convergence: levels between the finest mesh and the reference")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  CLI::Option* factors = app->add_option("--factors", o.factors,
                                         "thickness, stability: multiples of the case's thickness, from thick to thin")
                             ->delimiter(',')
                             ->check(CLI::PositiveNumber);
  app->add_option("--steps", steps, "thickness: that many halvings, in place of --factors")
      ->check(CLI::Range(1, 20))
      ->excludes(factors);
  app->add_option("--load-exponent", o.load_exponent, "thickness: loads go with factor^P; 0 without, 3 with obstacle");
  app->add_option("--samples", o.samples, "continuity: perturbations of each kind")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app->add_option("--size", o.size, "continuity: largest relative perturbation")
      ->check(CLI::Range(1e-6, 0.5))
      ->capture_default_str();
  app->add_option("--seed", o.seed, "continuity: of the random numbers")->capture_default_str();
  return app;
}

}  // namespace

int main(int argc, char** argv) {
  const algebra::Session session(argc, argv);
  CLI::App program("Plastron computes thin elastic shells (Naghdi's model) pressed on a rigid obstacle.");
  program.set_version_flag("--version", std::string(io::version));
  program.require_subcommand(1);
  program.footer("Exit codes: 0 solved, 2 bad input, 3 not converged, 4 internal error.");

  RunOptions options;
  CLI::App* run_command = program.add_subcommand("run", "Solve a case and write its results");
  run_command->add_option("CASE", options.case_file, "Case file (TOML)")->required();
  run_command->add_option("-o,--output", options.output, "Directory for results.json and the .vtu files")->required();
  run_command->add_flag("-q,--quiet", options.quiet, "Print errors only");
  CLI::App* check_command = program.add_subcommand("check", "Examine a case without solving it");
  check_command->add_option("CASE", options.case_file, "Case file (TOML)")->required();

  StudyCommand comparison{.kind = "compare", .case_file = {}, .output = {}};
  CLI::App* compare_command =
      program.add_subcommand("compare", "Solve a case in every formulation and set them side by side");
  compare_command->add_option("CASE", comparison.case_file, "Case file (TOML)")->required();
  compare_command->add_option("-o,--output", comparison.output, "Directory for compare.json and compare.svg")
      ->required();
  compare_command->add_flag("-q,--quiet", comparison.quiet, "Print errors only");
  StudyCommand study_options;
  std::optional<int> steps;
  CLI::App* study_command = add_study(program, study_options, steps);

  try {
    program.parse(argc, argv);
    if (const auto& f = study_options.options.factors; std::ranges::adjacent_find(f, std::less_equal<>{}) != f.end())
      throw CLI::ValidationError("--factors", "must fall from one to the next");
  } catch (const CLI::ParseError& error) {
    if (!is_first_rank()) return error.get_exit_code() == 0 ? solved : bad_input;
    return program.exit(error) == 0 ? solved : bad_input;
  }
  if (steps) {
    study_options.options.factors.clear();
    for (int i = 0; i <= *steps; ++i) study_options.options.factors.push_back(std::ldexp(1.0, -i));
  }
  if (study_command->parsed()) return guarded([&] { return study_case(study_options); });
  if (compare_command->parsed()) return guarded([&] { return study_case(comparison); });
  return guarded([&] { return run_command->parsed() ? run(options) : check(options.case_file); });
}

}  // namespace plastron::app

int main(int argc, char** argv) { return plastron::app::main(argc, argv); }
