// plastron-solver: what plastron becomes when there is something to compute, with the same arguments.
#include "commands.hpp"
#include "interruption.hpp"
#include "terminal.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/config/mistakes.hpp>
#include <plastron/fem/domain.hpp>

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
    if (is_first_rank()) print_text(stderr, errors.format());
    return bad_input;
  } catch (const fem::DomainError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const assembly::SupportError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  }
  // What follows may have struck one rank alone, so that rank speaks and takes the others down.
  catch (const std::bad_alloc&) {
    print_text(stderr, "error: not enough memory; reduce mesh.refinements or mesh.degree, or use more machines\n");
  } catch (const std::exception& error) {
    print_text(stderr, "internal error: " + config::printable(error.what()) + "\n");
  }
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks > 1) MPI_Abort(MPI_COMM_WORLD, internal_error);
  return internal_error;
}

/// Starts what computations need and runs a command.
ExitCode compute(int argc, char** argv, int threads, const std::function<ExitCode()>& command) {
  listen_for_interruptions();
  const algebra::Session session(argc, argv, threads);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  set_rank(rank);
  return guarded(command);
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
  CLI::App* app = program.add_subcommand("study", study_summary);
  app->footer(footer);
  app->add_option("KIND", command.kind, "What to examine; see below")->required()->check(CLI::IsMember(names));
  app->add_option("CASE", command.case_file, "Case file (TOML)")->required();
  add_output_options(*app, "Directory for KIND.json and KIND.svg", command.output, command.quiet, command.threads);
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
  secure_standard_streams();
  CLI::App program;
  describe_program(program);
  Options options;
  const CommonCommands commands = add_common_commands(program, options);
  StudyCommand study_options;
  std::optional<int> steps;
  CLI::App* study_command = add_study(program, study_options, steps);

  try {
    program.parse(argc, argv);
    if (const auto& f = study_options.options.factors; std::ranges::adjacent_find(f, std::less_equal<>{}) != f.end())
      throw CLI::ValidationError("--factors", "must fall from one to the next");
  } catch (const CLI::ParseError& error) {
    return answer(program, error);
  }
  if (steps) {
    study_options.options.factors.clear();
    for (int i = 0; i <= *steps; ++i) study_options.options.factors.push_back(std::ldexp(1.0, -i));
  }
  return compute(argc, argv, study_command->parsed() ? study_options.threads : options.threads, [&] {
    if (study_command->parsed()) return study_case(study_options);
    if (commands.compare->parsed())
      return study_case(
          {.kind = "compare", .case_file = options.case_file, .output = options.output, .quiet = options.quiet});
    return commands.run->parsed() ? run(options) : check(options.case_file);
  });
}

}  // namespace plastron::app

int main(int argc, char** argv) { return plastron::app::main(argc, argv); }
