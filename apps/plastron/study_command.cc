#include "study_command.hpp"

#include "command_line.hpp"

#include <research/names/study_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace plastron::app {

namespace {

/// Checks combinations of a study's options.
void check_study_options(const CLI::App& app, const study::KindName& kind, const std::vector<double>& factors) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_single_name(), takers = study::kinds_that_take(name);
    if (option->count() > 0 && !takers.empty() && !study::takes_option(kind, name))
      throw CLI::ValidationError("--" + name, fmt::format("{} does not take it; it is for: {}", kind.name, takers));
  }
  if (std::ranges::adjacent_find(factors, std::less_equal<>{}) != factors.end())
    throw CLI::ValidationError("--factors", "must fall from one to the next");
}

/// Adds options that only some kinds have. Returns the number of halvings.
std::shared_ptr<int> add_options_of_kinds(CLI::App& app, study::StudyOptions& o) {
  const auto add = [&app](const std::string& name, auto& value, const std::string& what) {
    return app.add_option("--" + name, value, study::kinds_that_take(name) + ": " + what);
  };
  add("reference", o.reference, "levels between the finest mesh and the reference")
      ->check(CLI::Range(1, 6))
      ->capture_default_str();
  CLI::Option* factors = add("factors", o.factors, "multiples of the case's thickness, from thick to thin")
                             ->delimiter(',')
                             ->check(CLI::PositiveNumber);
  auto steps = std::make_shared<int>(0);
  add("steps", *steps, "that many halvings, in place of --factors")->check(CLI::Range(1, 20))->excludes(factors);
  add("load-exponent", o.load_exponent, "loads go with factor^P; 0 without, 3 with obstacle");
  add("samples", o.samples, "perturbations of each kind")->check(CLI::Range(1, 100000))->capture_default_str();
  add("size", o.size, "largest relative perturbation")->check(CLI::Range(1e-6, 0.5))->capture_default_str();
  add("seed", o.seed, "of the random numbers")->capture_default_str();
  return steps;
}

}  // namespace

CLI::App* add_study(CLI::App& program, StudyCommand& command) {
  std::vector<std::string> names;
  std::string footer = "Kinds:\n";
  for (const study::KindName& kind : study::kind_names()) {
    names.emplace_back(kind.name);
    footer += fmt::format("  {:<12} {}\n", kind.name, kind.question);
  }
  CLI::App* app = program.add_subcommand("study", "Solve a case many times and examine a theorem or a limit with it");
  app->footer(footer);
  app->add_option("KIND", command.kind, "What to examine; see below")->required()->check(CLI::IsMember(names));
  app->add_option("CASE", command.case_file, "Case file (TOML)")->required();
  add_settings(*app, command.settings);
  add_json_log(*app, command.json_log);
  add_output_options(*app, "Directory for KIND.json and KIND.svg", command.output, command.quiet, command.threads);
  const auto steps = add_options_of_kinds(*app, command.options);
  app->callback([app, &command, steps] {
    if (*steps > 0)
      for (int i = 0; i <= *steps; ++i) command.options.factors.push_back(std::ldexp(1.0, -i));
    check_study_options(*app, *study::find_kind_name(command.kind), command.options.factors);
  });
  return app;
}

}  // namespace plastron::app
