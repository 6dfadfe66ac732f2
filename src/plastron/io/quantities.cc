#include <plastron/computation/warnings.hpp>
#include <plastron/io/quantities.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

using computation::Result;

/// Returns the depth of the shell in the obstacle between nodes; 0 if no cell is near it. Keeps a NaN.
double penetration(double min_gap_between) { return std::max(-min_gap_between, 0.0); }

}  // namespace

Json number(double value) {
  if (value == 0) return 0.0;
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json triple(const Eigen::Vector3d& v) { return Json::array({number(v[0]), number(v[1]), number(v[2])}); }

Json pair(const Eigen::Vector2d& v) { return Json::array({number(v[0]), number(v[1])}); }

std::span<const Quantity<Result>> result_quantities() {
  static const std::vector<Quantity<Result>> all{
      {"status", "-", "how the computation ended, in one word", [](auto& r) { return contact::to_string(r.status); }},
      {"status_text", "-", "the status in a sentence", [](auto& r) { return computation::status_text(r); }},
      {"formulation", "-", "method that imposes r . a_3 = 0 (shell.formulation)",
       [](auto& r) { return element::to_string(r.formulation); }},
      {"rotations", "-", "small: the linear model; finite: finite rotations (shell.rotations)",
       [](auto& r) { return r.rotations == element::Rotations::finite ? "finite" : "small"; }},
      {"energy", "J", "stored energy of the shell and its foundations, 1/2 a(U, U); W(U) with finite rotations",
       [](auto& r) { return r.summary.energy.total(); }},
      {"energy_parts/membrane", "J", "membrane part of the energy", [](auto& r) { return r.summary.energy.membrane; }},
      {"energy_parts/bending", "J", "bending part of the energy", [](auto& r) { return r.summary.energy.bending; }},
      {"energy_parts/shear", "J", "transverse shear part of the energy",
       [](auto& r) { return r.summary.energy.shear; }},
      {"energy_parts/foundations", "J", "energy of foundations, springs and hinges",
       [](auto& r) { return r.summary.energy.foundations; }},
      {"load_work", "J", "work of the loads, l(U)", [](auto& r) { return r.summary.load_work; }},
      {"moment_point", "m", "reference point of moments (output.moment_point)",
       [](auto& r) { return r.summary.moment_point; }},
      {"loads/force", "N", "resultant of all loads", [](auto& r) { return r.summary.loads.force; }},
      {"loads/moment", "N m", "resultant moment of all loads about moment_point",
       [](auto& r) { return r.summary.loads.moment; }},
      {"loads/sum_of_norms", "N", "sum of the norms of all nodal loads, couples over the shell's size",
       [](auto& r) { return r.summary.load_norms; }},
      {"reaction/force", "N", "resultant force of all obstacles on the shell",
       [](auto& r) { return r.summary.reaction.force; }},
      {"reaction/moment", "N m", "resultant moment of all obstacles on the shell about moment_point",
       [](auto& r) { return r.summary.reaction.moment; }},
      {"reaction/sum_of_norms", "N",
       "sum of the norms of the nodal forces of obstacles, which do not cancel as they do in a resultant",
       [](auto& r) { return r.summary.contact_norms(); }},
      {"support_reaction/force", "N", "resultant force of all supports on the shell",
       [](auto& r) { return r.summary.support_reaction.force; }},
      {"support_reaction/moment", "N m", "resultant moment of all supports on the shell about moment_point",
       [](auto& r) { return r.summary.support_reaction.moment; }},
      {"support_reaction/sum_of_norms", "N", "sum of the norms of the nodal forces of supports",
       [](auto& r) { return r.summary.support_norms; }},
      {"size/max_displacement", "m", "largest |u| at a node", [](auto& r) { return r.summary.max_displacement; }},
      {"size/max_relative_displacement", "1", "largest |u| / e at a node",
       [](auto& r) { return r.summary.max_relative_displacement; }},
      {"size/max_rotation", "rad",
       "largest |r| at a node; with finite rotations the largest angle between normal and director",
       [](auto& r) { return r.summary.max_rotation; }},
      {"linearity/status", "-",
       "comparison with the model of finite rotations: solved; unstable, if the shell buckles or snaps through near "
       "this solution; no_solution; unknown, if the contact problem of a step was not solved; not_made",
       [](auto& r) { return r.model ? computation::word_of(*r.model) : "not_made"; }},
      {"linearity/steps", "1", "Newton steps towards finite rotations",
       [](auto& r) { return r.model ? r.model->steps : 0; }},
      {"linearity/time", "1", "time of the solution of the comparison; null without steps",
       [](auto& r) { return r.model && !r.history.empty() ? std::optional(r.model->time) : std::nullopt; }},
      {"linearity/difference", "1",
       "largest relative error of linear numbers in linearity/quantities, without the contact area; a warning from "
       "0.05 on",
       [](auto& r) {
         return r.model && r.model->status == contact::Status::solved ? std::optional(r.model->largest())
                                                                      : std::nullopt;
       }},
      {"linearity/factorisations", "1", "numeric factorisations of the comparison",
       [](auto& r) { return r.model ? r.model->factorisations : 0; }},
      {"linearity/seconds", "s", "time of the comparison",
       [](auto& r) { return r.model ? std::optional(r.model->seconds) : std::nullopt; }},
      {"linearity/buckling", "1",
       "membrane forces over the forces under which a perfect shell with the same contact buckles; a warning from 0.5 "
       "on; null if not known",
       [](auto& r) { return r.levels.empty() ? std::nullopt : r.last_level().buckling; }},
      {"linearity/max_strain", "1",
       "largest absolute value of a principal strain at the faces; a warning from 0.02 on; most metals yield at 0.001 "
       "to 0.005",
       [](auto& r) { return r.summary.max_strain; }},
      {"stability/margin", "1",
       "with finite rotations, smallest theta of K_T v = theta K_M v on the touching face, K_T the tangent stiffness "
       "and K_M its part of the material: 1 without stresses, 0 at a critical state; a warning below 0.05; null with "
       "small rotations",
       [](auto& r) { return r.stability ? std::optional(r.stability->margin) : std::nullopt; }},
      {"stability/margin_without_weak_contact", "1",
       "the same if nodes may leave their obstacle whose eta is below 0.01 of its largest; null if nothing holds the "
       "shell then",
       [](auto& r) { return r.stability ? std::optional(r.stability->margin_without_weak_contact) : std::nullopt; }},
      {"stability/weak_nodes", "1", "number of these nodes",
       [](auto& r) { return r.stability ? r.stability->weak_nodes : 0; }},
      {"stability/margin_under_loads", "1",
       "where a displacement controls the loads, the margin if loads stay and this displacement is free: negative "
       "beyond a "
       "limit point of the loads; null without control",
       [](auto& r) { return r.stability ? r.stability->margin_under_loads : std::nullopt; }},
      {"stress/max_von_mises", "Pa", "largest von Mises stress at points of output, away from singular_places",
       [](auto& r) { return r.peak.von_mises; }},
      {"stress/error", "Pa",
       "estimated error of max_von_mises: the error of the goal \"stress\" if the case asks for it, else the "
       "difference from the resultants of its cell alone",
       [](auto& r) { return r.peak.error; }},
      {"stress/x", "the chart's", "parameters in Omega of the place of max_von_mises",
       [](auto& r) { return r.peak.x; }},
      {"stress/position", "m", "place of max_von_mises on the undeformed mid-surface",
       [](auto& r) { return r.peak.position; }},
      {"stress/height", "m", "height z of the place of max_von_mises over the mid-surface, along a_3",
       [](auto& r) { return r.peak.height; }},
      {"tangency/max_normal_rotation", "1", "largest |r . a_3| at nodes and quadrature points",
       [](auto& r) { return r.summary.max_normal_rotation; }},
      {"tangency/energy", "J", "energy of the penalty or of the stabilisation",
       [](auto& r) { return r.summary.tangency_energy; }},
      {"tangency/multiplier_norm", "N m", "norm of the gradient of lambda over the surface (mixed formulation)",
       [](auto& r) { return r.summary.multiplier_norm; }},
      {"memory/peak_bytes", "byte", "peak memory of all ranks together",
       [](auto& r) { return std::llround(r.peak_memory); }},
      {"ranks", "1", "number of MPI processes", [](auto& r) { return r.ranks; }},
  };
  return all;
}

std::span<const Quantity<computation::ModelQuantity>> model_quantities() {
  static const std::vector<Quantity<computation::ModelQuantity>> all{
      {"name", "-", "name of the number", [](auto& q) { return q.name; }},
      {"unit", "-", "unit of the number", [](auto& q) { return q.unit; }},
      {"linear", "see unit", "its value in the linear model", [](auto& q) { return q.linear; }},
      {"finite", "see unit", "nearly its value in the model of finite rotations", [](auto& q) { return q.finite; }},
      {"difference", "1", "relative error of the linear value", [](auto& q) { return q.difference(); }},
  };
  return all;
}

std::span<const Quantity<computation::Mode>> mode_quantities() {
  static const std::vector<Quantity<computation::Mode>> all{
      {"name", "-", "name of its field in solution.vtu: buckling_1, vibration_1, ...",
       [](auto& m) { return m.name(); }},
      {"load_factor", "1",
       "factor of loads, prescribed displacements and contact forces at which the shell buckles; null for vibrations",
       [](auto& m) { return m.kind == computation::Mode::Kind::buckling ? std::optional(m.value) : std::nullopt; }},
      {"frequency", "Hz", "natural frequency; null for buckling, and for a motion that grows",
       [](auto& m) {
         return m.kind == computation::Mode::Kind::vibration ? std::optional(m.frequency()) : std::nullopt;
       }},
      {"squared_angular_frequency", "1/s^2",
       "negative for a motion that grows: the solution is not stable; null for buckling",
       [](auto& m) { return m.kind == computation::Mode::Kind::vibration ? std::optional(m.value) : std::nullopt; }},
  };
  return all;
}

Json field_json(const computation::Mode& mode) {
  return {{"key", mode.name()},
          {"arrays", {mode.name()}},
          {"symbol", "v"},
          {"unit", "1"},
          {"meaning", "displacement of the mode; the largest is 1"}};
}

std::span<const Quantity<Result>> contact_quantities() {
  static const std::vector<Quantity<Result>> all{
      {"area", "m^2",
       "mid-surface area within the boundaries of the contact zones, summed over the obstacles. Contact along a line "
       "or at a point has none: the number then shows the mesh",
       [](auto& r) { return r.summary.contact_area; }},
      {"nodes", "1", "touching nodes", [](auto& r) { return r.summary.touching_nodes; }},
      {"min_gap", "m", "smallest gap at a node", [](auto& r) { return r.certificate.min_gap_nodes; }},
      {"max_penetration_between_nodes", "m",
       "penetration of the shell between nodes, where the gap is not constrained (contact.admissible = true makes it "
       "0)",
       [](auto& r) { return penetration(r.certificate.min_gap_between); }},
      {"max_pressure", "Pa",
       "largest eta at a node of a zone that has an area; if an edge carries a line reaction, nodes on edges do not "
       "count; null if all contact is along lines",
       [](auto& r) { return r.max_pressure(); }},
      {"edge/nodes", "1", "touching nodes on edges of the shell", [](auto& r) { return r.summary.edge.nodes; }},
      {"edge/force", "N", "sum of the forces at touching nodes on edges of the shell",
       [](auto& r) { return r.summary.edge.force; }},
      {"edge/max_line_reaction", "N/m",
       "largest force at a touching node on an edge over the node's length of edge; it converges if the edge carries a "
       "line reaction",
       [](auto& r) { return r.summary.edge.max_per_length; }},
      {"edge/is_line", "-", "true if the edge carries a line reaction; pressures at its nodes then depend on the mesh",
       [](auto& r) { return r.summary.edge.is_line(); }},
  };
  return all;
}

std::span<const Quantity<Result>> admissible_quantities() {
  static const std::vector<Quantity<Result>> all{
      {"rounds", "1", "rounds in which bounds of gaps were lifted, on the finest mesh",
       [](auto& r) { return r.last_level().lift_rounds; }},
      {"largest_lift", "m", "largest lower bound of a gap at a node, in place of 0",
       [](auto& r) { return r.summary.largest_lift; }},
      {"lift_work", "J",
       "sum of nodal reaction times lift; 1/2 a(U, U) - l(U) exceeds its minimum under the bounds at nodes alone by at "
       "most this number",
       [](auto& r) { return r.summary.lift_work; }},
      {"energy_before", "J", "stored energy before bounds were lifted",
       [](auto& r) { return r.last_level().energy_before_lifts; }},
      {"energy_change", "J", "change of the stored energy by the lifts",
       [](auto& r) { return r.last_level().energy - r.last_level().energy_before_lifts; }},
  };
  return all;
}

std::span<const Quantity<Result>> estimate_quantities() {
  static const std::vector<Quantity<Result>> all{
      {"energy_norm/squared", "J", "a(e, e) of the error e of the solution, estimated",
       [](auto& r) { return r.estimates->energy_norm_squared; }},
      {"energy_norm/relative", "1",
       "square root of a(e, e) / a(U, U); where the shell is at rest, over the energy of a strain that the model "
       "neglects",
       [](auto& r) {
         const double energy = std::max(r.summary.energy.total(), r.summary.least_energy());
         return energy > 0 ? std::sqrt(r.estimates->energy_norm_squared / (2 * energy)) : 0;
       }},
      {"unjudged_cells", "1", "cells without a neighbour for comparison; their estimated errors are too small",
       [](auto& r) { return r.estimates->unjudged_cells; }},
  };
  return all;
}

std::span<const Quantity<estimation::GeometryDeviation>> geometry_quantities() {
  static const std::vector<Quantity<estimation::GeometryDeviation>> all{
      {"deviation", "m", "estimated largest distance of the mesh from the part; null if not known",
       [](auto& g) { return g.largest; }},
      {"place", "m", "where it is", [](auto& g) { return g.place; }},
      {"judged_share", "1",
       "share of the area where the cells around tell the deviation; 0 for facets that are not plane",
       [](auto& g) { return g.judged_share; }},
  };
  return all;
}

std::span<const Quantity<estimation::GoalEstimate>> goal_quantities() {
  static const std::vector<Quantity<estimation::GoalEstimate>> all{
      {"name", "-", "name of the number", [](auto& g) { return g.name; }},
      {"unit", "-", "unit of the number", [](auto& g) { return g.unit; }},
      {"value", "see unit", "computed value", [](auto& g) { return g.value; }},
      {"tolerance", "1", "requested relative error; null if none was requested", [](auto& g) { return g.tolerance; }},
      {"scale", "see unit",
       "to which relative errors refer: |value|, or a part of usual values where the value vanishes; sums that cancel "
       "have the "
       "sizes of their terms",
       [](auto& g) { return g.scale; }},
      {"difference", "see unit",
       "estimate of the exact value minus value, from the solution of higher degree if there is one, else without the "
       "effect of the edges of contact zones",
       [](auto& g) { return g.difference(); }},
      {"corrected", "see unit", "value plus difference", [](auto& g) { return g.value + g.difference(); }},
      {"at_higher_degree", "see unit",
       "value on the same cells at degree k+1, if this solution was needed to confirm an accuracy, else null",
       [](auto& g) { return g.at_higher_degree; }},
      {"contact_edge", "see unit", "possible error by the edges of contact zones and by lifted bounds, of either sign",
       [](auto& g) { return g.contact_edge; }},
      {"error", "see unit", "estimate of |exact value - value|", [](auto& g) { return g.error(); }},
      {"geometry_error", "see unit",
       "estimated error by the mesh of the mid-surface; null on charts, and where it is unknown",
       [](auto& g) { return g.geometry_error; }},
      {"has_dual", "-", "true if the dual problem was solved; otherwise its part of the difference is missing",
       [](auto& g) { return g.has_dual; }},
      {"dual_energy", "J",
       "energy of the dual solution per squared unit; if it grows with refinement, the number has no limit",
       [](auto& g) { return g.dual_energy; }},
  };
  return all;
}

std::span<const Quantity<certificate::Certificate>> certificate_quantities() {
  static const std::vector<Quantity<certificate::Certificate>> all{
      {"stationarity", "1", "residual on the free coordinates over loads and reactions",
       [](auto& c) { return c.stationarity; }},
      {"min_pressure", "Pa", "smallest eta at a touching node", [](auto& c) { return c.min_pressure; }},
      {"min_gap_nodes", "m", "smallest gap at a node; null without obstacle", [](auto& c) { return c.min_gap_nodes; }},
      {"min_gap_between", "m", "smallest gap between nodes; null if no cell is near the obstacle",
       [](auto& c) { return c.min_gap_between; }},
      {"support_error", "m",
       "largest deviation of a supported component from its prescribed value, rotations times the thickness",
       [](auto& c) { return c.support_error; }},
      {"complementarity", "Pa m", "largest |eta g| at a node; where bounds are lifted, g is the gap minus the lift",
       [](auto& c) { return c.complementarity; }},
      {"force_balance", "1", "sum of loads and reactions over the largest of them",
       [](auto& c) { return c.force_balance; }},
      {"moment_balance", "1",
       "sum of moments about the origin over the largest of them; on curved shells it falls with the mesh size",
       [](auto& c) { return c.moment_balance; }},
      {"energy_identity", "1", "|a(U, U) - work of loads and reactions| over a(U, U); null with finite rotations",
       [](auto& c) { return c.energy_identity; }},
      {"energy_derivative", "1",
       "|derivative of the energy along (u, r) - work of the stresses along it| over that work; null with small "
       "rotations",
       [](auto& c) { return c.energy_derivative; }},
  };
  return all;
}

std::span<const Quantity<computation::Level>> level_quantities() {
  static const std::vector<Quantity<computation::Level>> all{
      {"cells", "1", "cells of the mesh", [](auto& l) { return l.cells; }},
      {"nodes", "1", "nodes", [](auto& l) { return l.nodes; }},
      {"unknowns", "1", "unknowns, including supported ones", [](auto& l) { return l.unknowns; }},
      {"time", "1", "time of the instant that was solved on it; 0 without steps", [](auto& l) { return l.time; }},
      {"active", "1", "touching nodes", [](auto& l) { return l.active; }},
      {"iterations", "1", "active-set iterations", [](auto& l) { return l.iterations; }},
      {"factorisations", "1", "numeric factorisations", [](auto& l) { return l.factorisations; }},
      {"linearisations", "1", "linearisations of the gaps of curved obstacles",
       [](auto& l) { return l.linearisations; }},
      {"lift_rounds", "1", "rounds in which bounds of gaps were lifted (contact.admissible)",
       [](auto& l) { return l.lift_rounds; }},
      {"gap_error", "m", "largest |distance - linearised gap| of the deformed faces in contact with curved obstacles",
       [](auto& l) { return l.gap_error; }},
      {"status", "-", "how the computation on this mesh ended, in one word",
       [](auto& l) { return contact::to_string(l.status); }},
      {"energy", "J", "stored energy", [](auto& l) { return l.energy; }},
      {"reaction", "N", "norm of the resultant force of the obstacles", [](auto& l) { return l.reaction; }},
      {"contact_area", "m^2", "mid-surface area within the boundaries of the contact zones, summed over the obstacles",
       [](auto& l) { return l.contact_area; }},
      {"max_normal_rotation", "1", "largest |r . a_3|", [](auto& l) { return l.max_normal_rotation; }},
      {"multiplier_norm", "N m", "norm of the gradient of lambda", [](auto& l) { return l.multiplier_norm; }},
      {"min_gap", "m", "smallest gap at a node; null without obstacle", [](auto& l) { return l.min_gap; }},
      {"linear_residual", "1", "relative residual of the last linear solve", [](auto& l) { return l.linear_residual; }},
      {"tolerances/bounds", "1", "tolerance of the bounds, over the largest displacement at contact nodes",
       [](auto& l) { return l.tolerances.gap; }},
      {"tolerances/signs", "1", "tolerance of the signs of reactions, over the largest reaction",
       [](auto& l) { return l.tolerances.multiplier; }},
      {"max_rotation", "rad", "largest |r|", [](auto& l) { return l.max_rotation; }},
      {"seconds/mesh", "s", "refinement, numbering, transfer", [](auto& l) { return l.seconds.mesh; }},
      {"seconds/discretisation", "s", "geometry, bounds, loads", [](auto& l) { return l.seconds.discretisation; }},
      {"seconds/assembly", "s", "stiffness matrix", [](auto& l) { return l.seconds.assembly; }},
      {"seconds/analysis", "s", "symbolic factorisation", [](auto& l) { return l.seconds.analysis; }},
      {"seconds/factorisation", "s", "numeric factorisations", [](auto& l) { return l.seconds.factorisation; }},
      {"seconds/iteration", "s", "active-set iteration without the factorisations",
       [](auto& l) { return l.seconds.iteration; }},
      {"seconds/certificate", "s", "the certificate", [](auto& l) { return l.seconds.certificate; }},
      {"seconds/estimates", "s", "estimates of errors", [](auto& l) { return l.seconds.estimates; }},
      {"seconds/geometry", "s", "solution on a second surface, for meshes in space",
       [](auto& l) { return l.seconds.geometry; }},
      {"seconds/witness", "s", "solution at degree k+1, if it was needed to confirm an accuracy",
       [](auto& l) { return l.seconds.witness; }},
      {"seconds/total", "s", "sum of all times", [](auto& l) { return l.seconds.total(); }},
  };
  return all;
}

std::span<const Quantity<computation::HistoryEntry>> history_quantities() {
  static const std::vector<Quantity<computation::HistoryEntry>> all{
      {"time", "1", "number of completed steps, plus the completed part of the present one",
       [](auto& h) { return h.factors.time; }},
      {"step", "-", "name of the step", [](auto& h) { return h.step; }},
      {"status", "-", "how this instant ended, in one word", [](auto& h) { return contact::to_string(h.status); }},
      {"load_factor", "1", "factor of all loads", [](auto& h) { return h.factors.loads; }},
      {"controlled_displacement", "m", "displacement that the loads follow; null without control",
       [](auto& h) { return h.controlled_displacement; }},
      {"support_factor", "1", "factor of the values of supports and rigid bodies",
       [](auto& h) { return h.factors.supports; }},
      {"energy", "J", "stored energy, 1/2 a(U, U); W(U) with finite rotations",
       [](auto& h) { return h.summary.energy.total(); }},
      {"load_work", "J", "work of the loads, l(U)", [](auto& h) { return h.summary.load_work; }},
      {"max_displacement", "m", "largest |u| at a node", [](auto& h) { return h.summary.max_displacement; }},
      {"contact_area", "m^2", "mid-surface area within the boundaries of the contact zones, summed over the obstacles",
       [](auto& h) { return h.summary.contact_area; }},
      {"max_pressure", "Pa", "largest eta at a node", [](auto& h) { return h.summary.max_pressure; }},
      {"min_gap", "m", "smallest gap at a node", [](auto& h) { return h.level.min_gap; }},
      {"support_force", "N", "resultant force of all supports on the shell",
       [](auto& h) { return h.summary.support_reaction.force; }},
      {"stability_margin", "1", "stability/margin at this instant; null with small rotations",
       [](auto& h) { return h.stability ? std::optional(h.stability->margin) : std::nullopt; }},
      {"has_jumped", "-",
       "with finite rotations: the shell snapped to this state, because a motion had no stiffness on the way",
       [](auto& h) { return h.level.has_jumped; }},
      {"margin_without_weak_contact", "1", "stability/margin_without_weak_contact at this instant",
       [](auto& h) { return h.stability ? std::optional(h.stability->margin_without_weak_contact) : std::nullopt; }},
      {"margin_under_loads", "1", "stability/margin_under_loads at this instant; null without control",
       [](auto& h) { return h.stability ? h.stability->margin_under_loads : std::nullopt; }},
      {"iterations", "1", "active-set iterations", [](auto& h) { return h.level.iterations; }},
      {"factorisations", "1", "numeric factorisations", [](auto& h) { return h.level.factorisations; }},
      {"cells", "1", "cells of its mesh; with [accuracy] instants may have different meshes",
       [](auto& h) { return h.level.cells; }},
      {"unknowns", "1", "unknowns on its mesh", [](auto& h) { return h.level.unknowns; }},
  };
  return all;
}

std::span<const Quantity<estimation::GoalRecord>> goal_record_quantities() {
  static const std::vector<Quantity<estimation::GoalRecord>> all{
      {"name", "-", "name of the number", [](auto& g) { return g.name; }},
      {"error", "1", "estimated error, relative to the number or to the usual size of such numbers",
       [](auto& g) { return g.relative_estimate(); }},
      {"tolerance", "1", "requested relative error", [](auto& g) { return g.tolerance; }},
  };
  return all;
}

std::span<const Quantity<contact::Iteration>> iteration_quantities() {
  static const std::vector<Quantity<contact::Iteration>> all{
      {"active", "1", "unknowns at a bound", [](auto& i) { return i.active; }},
      {"changes", "1", "unknowns that entered or left the active set", [](auto& i) { return i.changes; }},
      {"energy", "J", "potential energy, 1/2 a(U, U) - l(U)", [](auto& i) { return i.energy; }},
      {"worst_violation", "m", "largest violation of a bound", [](auto& i) { return i.worst_violation; }},
      {"worst_multiplier", "N", "most negative reaction at a node", [](auto& i) { return i.worst_multiplier; }},
      {"linear_steps", "1", "conjugate-gradient steps", [](auto& i) { return i.linear_steps; }},
      {"safeguarded", "-", "true if the safeguarded search made this iteration", [](auto& i) { return i.safeguarded; }},
  };
  return all;
}

}  // namespace plastron::io
