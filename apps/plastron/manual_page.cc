// plastron man: the manual page in troff format.
#include "command_line.hpp"
#include "command_list.hpp"
#include "terminal.hpp"

#include <plastron/contact/problem.hpp>
#include <plastron/io/results.hpp>

namespace plastron::app {

namespace {

/// Returns a text that troff prints unchanged: no request at the beginning of a line, minus signs that can be copied.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::string value_name(const Argument& option) {
  switch (option.accepts) {
    case Accepts::nothing:
      return "";
    case Accepts::directory:
      return "DIR";
    case Accepts::file:
      return "FILE";
    case Accepts::setting:
      return "KEY=VALUE";
    case Accepts::words:
      return "WORD";
    default:
      return "N";
  }
}

std::string synopsis(const Command& command) {
  std::string text = fmt::format("\\fBplastron {}\\fR", roff(command.name));
  for (const Argument& option : command.options)
    if (option.is_required)
      text += fmt::format(" \\fB{}\\fR \\fI{}\\fR", roff(option.names.back()), value_name(option));
  text += " [\\fIoptions\\fR]";
  for (const Argument& argument : command.positionals)
    text += argument.is_required ? fmt::format(" \\fI{}\\fR", argument.names[0])
                                 : fmt::format(" [\\fI{}\\fR]", argument.names[0]);
  return text;
}

std::string item(const std::string& label, const std::string& meaning) {
  return fmt::format(".TP\n{}\n{}\n", label, roff(meaning));
}

std::string describe(const Argument& option) {
  std::string label;
  for (const std::string& name : option.names)
    label += fmt::format("{}\\fB{}\\fR", label.empty() ? "" : ", ", roff(name));
  const std::string value = value_name(option);
  std::string meaning = option.meaning;
  if (!option.fallback.empty()) meaning += fmt::format(" (default: {})", option.fallback);
  return item(value.empty() ? label : fmt::format("{} \\fI{}\\fR", label, value), meaning);
}

std::string describe(const Command& command) {
  std::string text = fmt::format(".SS \"{}\"\n{}\n.PP\n{}.\n", command.name, synopsis(command), roff(command.meaning));
  for (const Argument& argument : command.positionals)
    text += item(fmt::format("\\fI{}\\fR", argument.names[0]), argument.meaning);
  for (const Argument& option : command.options)
    if (option.names.back() != "--help") text += describe(option);
  if (!command.footer.empty()) text += ".PP\n.nf\n" + roff(command.footer) + "\n.fi\n";
  return text;
}

std::string statuses() {
  std::string text = ".SH STATUSES\nHow a computation ends, in results.json and on the terminal.\n";
  for (const contact::Status status : contact::statuses())
    text += item(fmt::format("\\fB{}\\fR ({})", roff(contact::to_string(status)), static_cast<int>(exit_code(status))),
                 std::string(contact::explain(status)));
  return text;
}

constexpr const char* last_sections = R"(.SH FILES
A case is a TOML file; \fBplastron explain\fR explains its keys, \fBplastron new\fR writes one to start from.
\fBplastron run\fR writes results.json, solution.vtu and .pvd (for ParaView), obstacles.vtu, contact\-boundary.csv and .vtu,
history.csv and .svg if there are steps, and solution.plastron and solution.case.toml for \fBplastron verify\fR.
.SH EXAMPLES
.nf
plastron new bowl
plastron check bowl/case.toml
plastron run bowl/case.toml \-\-output out/bowl \-\-set mesh.refinements=2
plastron verify out/bowl
mpirun \-n 2 plastron run bowl/case.toml \-\-output out/bowl
.fi
)";

}  // namespace

ExitCode print_manual_page(const CLI::App& program) {
  const auto commands = command_list(program);
  std::string text = fmt::format(".TH PLASTRON 1 \"\" \"plastron {}\" \"User Commands\"\n", roff(io::version));
  text += ".SH NAME\nplastron \\- thin elastic shells pressed on rigid obstacles\n.SH SYNOPSIS\n";
  for (const Command& command : commands) text += synopsis(command) + "\n.br\n";
  text += ".SH DESCRIPTION\n" + roff(program.get_description()) + "\n.SH COMMANDS\n";
  for (const Command& command : commands) text += describe(command);
  text += ".SH EXIT STATUS\n" + roff(program.get_footer()) + "\n";
  if (is_first_rank()) print_raw(stdout, text + statuses() + last_sections);
  return solved;
}

}  // namespace plastron::app
