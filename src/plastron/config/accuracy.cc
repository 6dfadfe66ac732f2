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
constexpr Range tolerances{.low = 1e-10, .high = 0.5};

void read_other_goals(Table& accuracy, const std::vector<std::string>& known, problem::Accuracy& given) {
  Reading& reading = accuracy.reading();
  for (const auto& [name, value] : accuracy.other_entries()) {
    if (std::ranges::count(known, name) == 0) {
      reading.report(
          reading.source.key(name, value),
          fmt::format("there is no number \"{}\" whose accuracy could be asked for", geometry::shortened(name)),
          joined(known), did_you_mean(name, known));
      continue;
    }
    if (const auto tolerance = read_number(reading, Item{value, name, tolerances})) {
      given.goals.push_back({name, *tolerance});
      accuracy.effective[name] = *tolerance;
    }
  }
}

void read_goals(Table& table, const problem::Problem& problem, problem::Accuracy& given) {
  const std::vector<std::string> known = problem::goal_names(problem);
  for (const char* name : {"energy", "reaction", "contact_area"}) {
    const auto tolerance = table.number(name);
    if (!tolerance) continue;
    if (std::ranges::count(known, name) == 0)
      table.report(name, fmt::format("there is no obstacle, and so no {}", name), joined(known), "leave it out");
    given.goals.push_back({name, *tolerance});
  }
  const bool asks_for_none = given.goals.empty() && table.other_entries().empty();
  read_other_goals(table, known, given);
  for (const char* name : {"energy", "reaction"})
    if (asks_for_none && std::ranges::count(known, name) > 0) {
      given.goals.push_back({name, default_tolerance});
      table.effective[name] = default_tolerance;
    }
}

}  // namespace

std::vector<Section> accuracy_sections() {
  return {{"accuracy",
           "[accuracy]",
           "Required accuracy of results. Meshes are refined where the errors matter, until twice each estimated "
           "error is below its tolerance. Errors are estimated by recovered stress resultants, and by a second "
           "solution on the same cells with one degree more. (On triangles the estimates must hold on two meshes "
           "in a row instead.) A tolerance is relative to the size of the number, or to a thousandth of the largest "
           "number of its kind if that is larger: a component that vanishes by symmetry has no digits. The tolerance "
           "of the "
           "reaction is relative to the sum of the forces of all obstacles; it holds for the force of each obstacle, "
           "too. Without [mesh] and [accuracy] the tolerances of energy and reaction are 1e-3. All triangles are "
           "refined together. The same holds for cells along joined edges and along edges of rigid bodies. If a mesh "
           "does not fit into the memory of the machine, it is not solved, and the status is accuracy_not_reached.",
           {key("energy", Kind::number, {.range = tolerances}, "tolerance of the stored energy"),
            key("reaction", Kind::number, {.range = tolerances},
                "tolerance of the norm of the reaction, of all obstacles together and of each one"),
            key("contact_area", Kind::number, {.range = tolerances}, "tolerance of the area of the contact zones"),
            key("max_unknowns", &problem::Accuracy::max_unknowns, {.fallback = "2e6", .range = {.low = 1}},
                "largest number of unknowns of a solution, and of the second solution that estimates its errors; if it "
                "does not suffice, the status is accuracy_not_reached"),
            key("max_seconds", &problem::Accuracy::max_seconds, {.unit = "s", .range = Range::positive()},
                "time limit. A mesh that would end later, with the steps on it, is not started. Meshes stop at the "
                "limit, and so does the search for modes; only the first mesh is solved to its end, however long it "
                "takes. If the time does not suffice, the status is accuracy_not_reached")},
           {},
           "tolerances of other numbers of results.json, with their names in quotes: \"probe.NAME.u.z\" and other "
           "components of u, r, N, M, Q; \"probe.NAME.stress_upper.11\", stress_middle, stress_lower, .von_mises; "
           "\"stress\", the largest von Mises stress; \"support.BOUNDARY.force.z\"; \"obstacle.NAME.force.z\", .area "
           "and, for an obstacle with a force, .position; load_work"}};
}

void read_accuracy(Table& root, problem::Problem& problem) {
  if (!root.has("accuracy") && root.has("mesh")) return;
  root.in_table("accuracy", [&](Table& table) {
    problem::Accuracy given;
    read_goals(table, problem, given);
    table.fill(given);
    problem.accuracy = std::move(given);
  });
}

}  // namespace plastron::config
