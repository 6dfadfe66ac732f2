// plastron-solver: what plastron becomes when there is something to compute, with the same arguments.
#include "commands.hpp"
#include "interruption.hpp"
#include "reading.hpp"
#include "terminal.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/assembly/load_vector.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/config/mistakes.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/io/unusable_results.hpp>
#include <plastron/obstacle/error.hpp>

#include <mpi.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <new>

namespace plastron::app {

namespace {

/// Runs a command and turns what it throws into a message and an exit code.
ExitCode guarded(const std::function<ExitCode()>& command) {
  try {
    return command();
  } catch (const RefusedCase& refused) {
    if (is_first_rank()) print_text(stderr, refused.what());
    return bad_input;
  } catch (const fem::DomainError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const assembly::SupportError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const obstacle::ObstacleError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const assembly::LoadError& error) {
    print_error("error: {}\n", error.what());
    return bad_input;
  } catch (const io::UnusableResults& error) {
    if (is_first_rank()) print_text(stderr, fmt::format("error: {}\n", error.what()));
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

/// What is wrong with the options of a study beyond their single values.
void check_study_options(const CLI::App& app, const study::Kind& kind, const std::vector<double>& factors) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_single_name(), takers = study::kinds_that_take(name);
    if (option->count() > 0 && !takers.empty() && !study::takes_option(kind, name))
      throw CLI::ValidationError("--" + name, fmt::format("{} does not take it; it is for: {}", kind.name, takers));
  }
  if (std::ranges::adjacent_find(factors, std::less_equal<>{}) != factors.end())
    throw CLI::ValidationError("--factors", "must fall from one to the next");
}

/// Declares `plastron study`: one table of kinds, and options that concern some of them.
CLI::App* add_study(CLI::App& program, StudyCommand& command) {
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
  const auto add = [app](const std::string& name, auto& value, const std::string& what) {
    return app->add_option("--" + name, value, study::kinds_that_take(name) + ": " + what);
  };
  add("reference", o.reference, "levels between the finest mesh and the reference")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  CLI::Option* factors = add("factors", o.factors, "multiples of the case's thickness, from thick to thin")
                             ->delimiter(',')
                             ->check(CLI::PositiveNumber);
  const auto steps = std::make_shared<int>(0);
  add("steps", *steps, "that many halvings, in place of --factors")->check(CLI::Range(1, 20))->excludes(factors);
  add("load-exponent", o.load_exponent, "loads go with factor^P; 0 without, 3 with obstacle");
  add("samples", o.samples, "perturbations of each kind")->check(CLI::Range(1, 100000))->capture_default_str();
  add("size", o.size, "largest relative perturbation")->check(CLI::Range(1e-6, 0.5))->capture_default_str();
  add("seed", o.seed, "of the random numbers")->capture_default_str();
  app->callback([app, &command, steps] {
    if (*steps > 0)
      for (int i = 0; i <= *steps; ++i) command.options.factors.push_back(std::ldexp(1.0, -i));
    check_study_options(*app, *study::find_kind(command.kind), command.options.factors);
  });
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
  CLI::App* study_command = add_study(program, study_options);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer(program, error);
  }
  return compute(argc, argv, study_command->parsed() ? study_options.threads : options.threads, [&] {
    if (study_command->parsed()) return study_case(study_options);
    if (commands.compare->parsed())
      return study_case({.kind = options.solvers ? "compare-solvers" : "compare",
                         .case_file = options.case_file,
                         .output = options.output,
                         .quiet = options.quiet});
    if (commands.verify->parsed()) return verify(options);
    return commands.run->parsed() ? run(options) : check(options.case_file);
  });
}

}  // namespace plastron::app

int main(int argc, char** argv) { return plastron::app::main(argc, argv); }
