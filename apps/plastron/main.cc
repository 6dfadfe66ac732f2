// plastron: the command line.
#include "commands.hpp"
#include "console.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/config/mistakes.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/io/version.hpp>

#include <mpi.h>
#include <CLI/CLI.hpp>

#include <functional>
#include <new>

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

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (!is_first_rank()) return error.get_exit_code() == 0 ? solved : bad_input;
    return program.exit(error) == 0 ? solved : bad_input;
  }
  return guarded([&] { return run_command->parsed() ? run(options) : check(options.case_file); });
}

}  // namespace plastron::app

int main(int argc, char** argv) { return plastron::app::main(argc, argv); }
