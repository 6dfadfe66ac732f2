// [mesh] and [solver].
#include <plastron/config/sections.hpp>

namespace plastron::config {

void read_mesh(Table& root, study::Problem& problem) {
  auto mesh = root.table("mesh");
  if (!mesh) return;
  study::Discretisation& d = problem.discretisation;
  mesh->text("cells");
  d.degree = mesh->integer("degree").value_or(d.degree);
  d.tying = mesh->boolean("tying").value_or(d.tying);
  d.refinements = mesh->integer("refinements").value_or(d.refinements);
  root.effective["mesh"] = mesh->effective;
}

void read_solver(Table& root, study::Problem& problem) {
  auto solver = root.table("solver");
  if (!solver) return;
  contact::Settings& s = problem.contact;
  s.max_iterations = solver->integer("max_iterations").value_or(s.max_iterations);
  s.linear_tolerance = solver->number("linear_tolerance").value_or(s.linear_tolerance);
  s.gap_tolerance = solver->number("gap_tolerance").value_or(s.gap_tolerance);
  s.multiplier_tolerance = solver->number("multiplier_tolerance").value_or(s.multiplier_tolerance);
  root.effective["solver"] = solver->effective;
}

}  // namespace plastron::config
