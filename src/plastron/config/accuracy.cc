// Reads [accuracy]: the required accuracy, in place of a mesh.
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>
#include <plastron/problem/goal_names.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

/// Tolerance of energy and reaction in a case without mesh and accuracy.
constexpr double default_tolerance = 1e-3;

void read_other_goals(Table& accuracy, const std::vector<std::string>& known, problem::Accuracy& given) {
  Reading& reading = accuracy.reading();
  const Range range = section("accuracy").keys.front().range;
  for (const auto& [name, value] : accuracy.other_entries()) {
    if (std::ranges::count(known, name) == 0) {
      reading.report(
          reading.source.key(name, value),
          fmt::format("there is no number \"{}\" whose accuracy could be asked for", geometry::shortened(name)),
          joined(known), did_you_mean(name, known));
      continue;
    }
    if (const auto tolerance = read_number(reading, Item{value, name, range})) {
      given.goals.push_back({name, *tolerance});
      accuracy.effective[name] = *tolerance;
    }
  }
}

}  // namespace

void read_accuracy(Table& root, problem::Problem& problem) {
  if (!root.has("accuracy") && root.has("mesh")) return;
  auto table = root.table("accuracy");
  if (!table) return;
  const std::vector<std::string> known = problem::goal_names(problem);
  problem::Accuracy given;
  for (const char* name : {"energy", "reaction", "contact_area"}) {
    const auto tolerance = table->number(name);
    if (!tolerance) continue;
    if (std::ranges::count(known, name) == 0)
      table->report(name, fmt::format("there is no obstacle, and so no {}", name), joined(known), "leave it out");
    given.goals.push_back({name, *tolerance});
  }
  const bool asks_for_none = given.goals.empty() && table->other_entries().empty();
  read_other_goals(*table, known, given);
  for (const char* name : {"energy", "reaction"})
    if (asks_for_none && std::ranges::count(known, name) > 0) {
      given.goals.push_back({name, default_tolerance});
      table->effective[name] = default_tolerance;
    }
  given.max_unknowns = table->number("max_unknowns").value_or(given.max_unknowns);
  given.max_seconds = table->number("max_seconds").value_or(given.max_seconds);
  root.effective["accuracy"] = table->effective;
  problem.accuracy = std::move(given);
}

}  // namespace plastron::config
