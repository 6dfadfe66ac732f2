// The main function of plastron-solver and plastron-study, which plastron starts with the same arguments for a
// computation. The version of carry_out() determines the program.
#include "command_line.hpp"
#include "console.hpp"
#include "terminal.hpp"

#include <plastron/algebra/session.hpp>
#include <plastron/io/atomic_file.hpp>
#include <plastron/io/results.hpp>
#include <plastron/workflow/read.hpp>

#include <mpi.h>

#include <functional>
#include <new>

namespace plastron::app {

namespace {

/// Runs a command and converts exceptions to a message and an exit code.
ExitCode guarded(const std::function<ExitCode()>& command) {
  try {
    ExitCode code = solved;
    workflow::refusing([&] { code = command(); });
    return code;
  } catch (const workflow::RefusedCase& refused) {
    if (is_first_rank()) print_text(stderr, refused.what());
    return bad_input;
  } catch (const io::UnusableResults& error) {
    if (is_first_rank()) print_text(stderr, fmt::format("error: {}\n", error.what()));
    return bad_input;
  } catch (const io::WriteError& error) {
    print_error(
        "error: {}; earlier files have not changed. Free space there, or choose another directory with --output\n",
        error.what());
    return bad_input;
  }
  // The following errors may occur on one rank only, so this rank prints the message and ends the others.
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

/// Starts MPI and other parts that computations need, and runs a command.
ExitCode compute(int argc, char** argv, int threads, const std::function<ExitCode()>& command) {
  listen_for_interruptions();
  const algebra::Session session(argc, argv, threads);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  set_rank(rank);
  const ExitCode code = guarded(command);
  log_event("exit", {{"exit_code", static_cast<int>(code)}});
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  secure_standard_streams();
  CommandLine line;
  try {
    line.program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return answer(line.program, error);
  }
  const bool is_study = line.study->parsed();
  if (is_study ? line.study_options.json_log : line.options.json_log) log_events();
  const int threads = is_study ? line.study_options.threads : line.options.threads;
  return compute(argc, argv, threads, [&] { return carry_out(line); });
}

}  // namespace plastron::app

int main(int argc, char** argv) { return plastron::app::main(argc, argv); }
