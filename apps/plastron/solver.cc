// The commands of plastron-solver.
#include "commands.hpp"

namespace plastron::app {

ExitCode carry_out(const CommandLine& line) {
  if (line.commands.verify->parsed()) return verify(line.options);
  return line.commands.run->parsed() ? run(line.options) : check(line.options);
}

}  // namespace plastron::app
