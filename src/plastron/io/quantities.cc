#include <plastron/computation/warnings.hpp>
#include <plastron/io/quantities.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

using computation::Result;

Json known(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

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
      {"status", "-", "how the computation ended, in one word",
       [](const Result& r) { return Json(contact::to_string(r.status)); }, Form::text},
      {"status_text", "-", "the status in a sentence",
       [](const Result& r) { return Json(computation::status_text(r)); }, Form::text},
      {"formulation", "-", "method that imposes r . a_3 = 0 (shell.formulation)",
       [](const Result& r) { return Json(element::to_string(r.formulation)); }, Form::text},
      {"rotations", "-", "small: the linear model; finite: finite rotations (shell.rotations)",
       [](const Result& r) { return Json(r.rotations == element::Rotations::finite ? "finite" : "small"); },
       Form::text},
      {"energy", "J", "stored energy of the shell and its foundations, 1/2 a(U, U); W(U) with finite rotations",
       [](const Result& r) { return number(r.summary.energy.total()); }},
      {"energy_parts/membrane", "J", "membrane part of the energy",
       [](const Result& r) { return number(r.summary.energy.membrane); }},
      {"energy_parts/bending", "J", "bending part of the energy",
       [](const Result& r) { return number(r.summary.energy.bending); }},
      {"energy_parts/shear", "J", "transverse shear part of the energy",
       [](const Result& r) { return number(r.summary.energy.shear); }},
      {"energy_parts/foundations", "J", "energy of foundations, springs and hinges",
       [](const Result& r) { return number(r.summary.energy.foundations); }},
      {"load_work", "J", "work of the loads, l(U)", [](const Result& r) { return number(r.summary.load_work); }},
      {"moment_point", "m", "reference point of moments (output.moment_point)",
       [](const Result& r) { return triple(r.summary.moment_point); }, Form::triple},
      {"loads/force", "N", "resultant of all loads", [](const Result& r) { return triple(r.summary.loads.force); },
       Form::triple},
      {"loads/moment", "N m", "resultant moment of all loads about moment_point",
       [](const Result& r) { return triple(r.summary.loads.moment); }, Form::triple},
      {"loads/sum_of_norms", "N", "sum of the norms of all nodal loads, couples over the shell's size",
       [](const Result& r) { return number(r.summary.load_norms); }},
      {"reaction/force", "N", "resultant force of all obstacles on the shell",
       [](const Result& r) { return triple(r.summary.reaction.force); }, Form::triple},
      {"reaction/moment", "N m", "resultant moment of all obstacles on the shell about moment_point",
       [](const Result& r) { return triple(r.summary.reaction.moment); }, Form::triple},
      {"reaction/sum_of_norms", "N",
       "sum of the norms of the nodal forces of obstacles, which do not cancel as they do in a resultant",
       [](const Result& r) { return number(r.summary.contact_norms()); }},
      {"support_reaction/force", "N", "resultant force of all supports on the shell",
       [](const Result& r) { return triple(r.summary.support_reaction.force); }, Form::triple},
      {"support_reaction/moment", "N m", "resultant moment of all supports on the shell about moment_point",
       [](const Result& r) { return triple(r.summary.support_reaction.moment); }, Form::triple},
      {"support_reaction/sum_of_norms", "N", "sum of the norms of the nodal forces of supports",
       [](const Result& r) { return number(r.summary.support_norms); }},
      {"size/max_displacement", "m", "largest |u| at a node",
       [](const Result& r) { return number(r.summary.max_displacement); }},
      {"size/max_relative_displacement", "1", "largest |u| / e at a node",
       [](const Result& r) { return number(r.summary.max_relative_displacement); }},
      {"size/max_rotation", "rad",
       "largest |r| at a node; with finite rotations the largest angle between normal and director",
       [](const Result& r) { return number(r.summary.max_rotation); }},
      {"linearity/status", "-",
       "comparison with the model of finite rotations: solved; unstable, if the shell buckles or snaps through near "
       "this solution; no_solution; unknown, if the contact problem of a step was not solved; not_made",
       [](const Result& r) { return Json(r.model ? computation::word_of(*r.model) : "not_made"); }, Form::text},
      {"linearity/steps", "1", "Newton steps towards finite rotations",
       [](const Result& r) { return Json(r.model ? r.model->steps : 0); }, Form::integer},
      {"linearity/time", "1", "time of the solution of the comparison; null without steps",
       [](const Result& r) { return r.model && !r.history.empty() ? number(r.model->time) : Json(nullptr); }},
      {"linearity/difference", "1",
       "largest relative error of linear numbers in linearity/quantities, without the contact area; a warning from "
       "0.05 on",
       [](const Result& r) {
         return r.model && r.model->status == contact::Status::solved ? number(r.model->largest()) : Json(nullptr);
       }},
      {"linearity/factorisations", "1", "numeric factorisations of the comparison",
       [](const Result& r) { return Json(r.model ? r.model->factorisations : 0); }, Form::integer},
      {"linearity/seconds", "s", "time of the comparison",
       [](const Result& r) { return r.model ? number(r.model->seconds) : Json(nullptr); }},
      {"linearity/buckling", "1",
       "membrane forces over the forces under which a perfect shell with the same contact buckles; a warning from 0.5 "
       "on; null if not known",
       [](const Result& r) { return r.levels.empty() ? Json(nullptr) : known(r.last_level().buckling); }},
      {"linearity/max_strain", "1",
       "largest absolute value of a principal strain at the faces; a warning from 0.02 on; most metals yield at 0.001 "
       "to 0.005",
       [](const Result& r) { return number(r.summary.max_strain); }},
      {"stability/margin", "1",
       "with finite rotations, smallest theta of K_T v = theta K_M v on the touching face, K_T the tangent stiffness "
       "and K_M its part of the material: 1 without stresses, 0 at a critical state; a warning below 0.05; null with "
       "small rotations",
       [](const Result& r) { return r.stability ? number(r.stability->margin) : Json(nullptr); }},
      {"stability/margin_without_weak_contact", "1",
       "the same if nodes may leave their obstacle whose eta is below 0.01 of its largest; null if nothing holds the "
       "shell then",
       [](const Result& r) { return r.stability ? number(r.stability->margin_without_weak_contact) : Json(nullptr); }},
      {"stability/weak_nodes", "1", "number of these nodes",
       [](const Result& r) { return Json(r.stability ? r.stability->weak_nodes : 0); }, Form::integer},
      {"stability/margin_under_loads", "1",
       "where a displacement controls the loads, the margin if loads stay and this displacement is free: negative "
       "beyond a "
       "limit point of the loads; null without control",
       [](const Result& r) {
         return r.stability && r.stability->margin_under_loads ? number(*r.stability->margin_under_loads)
                                                               : Json(nullptr);
       }},
      {"stress/max_von_mises", "Pa", "largest von Mises stress at points of output, away from singular_places",
       [](const Result& r) { return number(r.peak.von_mises); }},
      {"stress/error", "Pa",
       "estimated error of max_von_mises: the error of the goal \"stress\" if the case asks for it, else the "
       "difference from the resultants of its cell alone",
       [](const Result& r) { return number(r.peak.error); }},
      {"stress/x", "the chart's", "parameters in Omega of the place of max_von_mises",
       [](const Result& r) { return pair(r.peak.x); }, Form::pair},
      {"stress/position", "m", "place of max_von_mises on the undeformed mid-surface",
       [](const Result& r) { return triple(r.peak.position); }, Form::triple},
      {"stress/height", "m", "height z of the place of max_von_mises over the mid-surface, along a_3",
       [](const Result& r) { return number(r.peak.height); }},
      {"tangency/max_normal_rotation", "1", "largest |r . a_3| at nodes and quadrature points",
       [](const Result& r) { return number(r.summary.max_normal_rotation); }},
      {"tangency/energy", "J", "energy of the penalty or of the stabilisation",
       [](const Result& r) { return number(r.summary.tangency_energy); }},
      {"tangency/multiplier_norm", "N m", "norm of the gradient of lambda over the surface (mixed formulation)",
       [](const Result& r) { return number(r.summary.multiplier_norm); }},
      {"memory/peak_bytes", "byte", "peak memory of all ranks together",
       [](const Result& r) { return Json(std::llround(r.peak_memory)); }, Form::integer},
      {"ranks", "1", "number of MPI processes", [](const Result& r) { return Json(r.ranks); }, Form::integer},
  };
  return all;
}

std::span<const Quantity<computation::ModelQuantity>> model_quantities() {
  using computation::ModelQuantity;
  static const std::vector<Quantity<ModelQuantity>> all{
      {"name", "-", "name of the number", [](const ModelQuantity& q) { return Json(q.name); }, Form::text},
      {"unit", "-", "unit of the number", [](const ModelQuantity& q) { return Json(q.unit); }, Form::text},
      {"linear", "see unit", "its value in the linear model", [](const ModelQuantity& q) { return number(q.linear); }},
      {"finite", "see unit", "nearly its value in the model of finite rotations",
       [](const ModelQuantity& q) { return number(q.finite); }},
      {"difference", "1", "relative error of the linear value",
       [](const ModelQuantity& q) { return number(q.difference()); }},
  };
  return all;
}

std::span<const Quantity<computation::Mode>> mode_quantities() {
  using computation::Mode;
  static const std::vector<Quantity<Mode>> all{
      {"name", "-", "name of its field in solution.vtu: buckling_1, vibration_1, ...",
       [](const Mode& m) { return Json(m.name()); }, Form::text},
      {"load_factor", "1",
       "factor of loads, prescribed displacements and contact forces at which the shell buckles; null for vibrations",
       [](const Mode& m) { return m.kind == Mode::Kind::buckling ? number(m.value) : Json(nullptr); }},
      {"frequency", "Hz", "natural frequency; null for buckling, and for a motion that grows",
       [](const Mode& m) { return m.kind == Mode::Kind::vibration ? number(m.frequency()) : Json(nullptr); }},
      {"squared_angular_frequency", "1/s^2",
       "negative for a motion that grows: the solution is not stable; null for buckling",
       [](const Mode& m) { return m.kind == Mode::Kind::vibration ? number(m.value) : Json(nullptr); }},
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
      {"area", "m^2", "mid-surface area within the boundaries of the contact zones, summed over the obstacles",
       [](const Result& r) { return number(r.summary.contact_area); }},
      {"nodes", "1", "touching nodes", [](const Result& r) { return Json(r.summary.touching_nodes); }, Form::integer},
      {"min_gap", "m", "smallest gap at a node", [](const Result& r) { return number(r.certificate.min_gap_nodes); }},
      {"max_penetration_between_nodes", "m",
       "penetration of the shell between nodes, where the gap is not constrained (contact.admissible = true makes it "
       "0)",
       [](const Result& r) { return number(penetration(r.certificate.min_gap_between)); }},
      {"max_pressure", "Pa",
       "largest eta at a node of a zone that has an area; if an edge carries a line reaction, nodes on edges do not "
       "count; null if all contact is along lines",
       [](const Result& r) { return number(r.max_pressure()); }},
      {"edge/nodes", "1", "touching nodes on edges of the shell",
       [](const Result& r) { return Json(r.summary.edge.nodes); }, Form::integer},
      {"edge/force", "N", "sum of the forces at touching nodes on edges of the shell",
       [](const Result& r) { return number(r.summary.edge.force); }},
      {"edge/max_line_reaction", "N/m",
       "largest force at a touching node on an edge over the node's length of edge; it converges if the edge carries a "
       "line reaction",
       [](const Result& r) { return number(r.summary.edge.max_per_length); }},
      {"edge/is_line", "-", "true if the edge carries a line reaction; pressures at its nodes then depend on the mesh",
       [](const Result& r) { return Json(r.summary.edge.is_line()); }, Form::flag},
  };
  return all;
}

std::span<const Quantity<Result>> admissible_quantities() {
  static const std::vector<Quantity<Result>> all{
      {"rounds", "1", "rounds in which bounds of gaps were lifted, on the finest mesh",
       [](const Result& r) { return Json(r.last_level().lift_rounds); }, Form::integer},
      {"largest_lift", "m", "largest lower bound of a gap at a node, in place of 0",
       [](const Result& r) { return number(r.summary.largest_lift); }},
      {"lift_work", "J",
       "sum of nodal reaction times lift; 1/2 a(U, U) - l(U) exceeds its minimum under the bounds at nodes alone by at "
       "most this number",
       [](const Result& r) { return number(r.summary.lift_work); }},
      {"energy_before", "J", "stored energy before bounds were lifted",
       [](const Result& r) { return number(r.last_level().energy_before_lifts); }},
      {"energy_change", "J", "change of the stored energy by the lifts",
       [](const Result& r) { return number(r.last_level().energy - r.last_level().energy_before_lifts); }},
  };
  return all;
}

std::span<const Quantity<Result>> estimate_quantities() {
  static const std::vector<Quantity<Result>> all{
      {"energy_norm/squared", "J", "a(e, e) of the error e of the solution, estimated",
       [](const Result& r) { return number(r.estimates->energy_norm_squared); }},
      {"energy_norm/relative", "1",
       "square root of a(e, e) / a(U, U); where the shell is at rest, over the energy of a strain that the model "
       "neglects",
       [](const Result& r) {
         const double energy = std::max(r.summary.energy.total(), r.summary.least_energy());
         return number(energy > 0 ? std::sqrt(r.estimates->energy_norm_squared / (2 * energy)) : 0);
       }},
      {"unjudged_cells", "1", "cells without a neighbour for comparison; their estimated errors are too small",
       [](const Result& r) { return Json(r.estimates->unjudged_cells); }, Form::integer},
  };
  return all;
}

std::span<const Quantity<estimation::GeometryDeviation>> geometry_quantities() {
  using estimation::GeometryDeviation;
  static const std::vector<Quantity<GeometryDeviation>> all{
      {"deviation", "m", "estimated largest distance of the mesh from the part; null if not known",
       [](const GeometryDeviation& g) { return number(g.largest); }},
      {"place", "m", "where it is", [](const GeometryDeviation& g) { return Json(g.place); }, Form::triple},
      {"judged_share", "1",
       "share of the area where the cells around tell the deviation; 0 for facets that are not plane",
       [](const GeometryDeviation& g) { return number(g.judged_share); }},
  };
  return all;
}

std::span<const Quantity<estimation::GoalEstimate>> goal_quantities() {
  using estimation::GoalEstimate;
  static const std::vector<Quantity<GoalEstimate>> all{
      {"name", "-", "name of the number", [](const GoalEstimate& g) { return Json(g.name); }, Form::text},
      {"unit", "-", "unit of the number", [](const GoalEstimate& g) { return Json(g.unit); }, Form::text},
      {"value", "see unit", "computed value", [](const GoalEstimate& g) { return number(g.value); }},
      {"tolerance", "1", "requested relative error; null if none was requested",
       [](const GoalEstimate& g) { return known(g.tolerance); }},
      {"scale", "see unit",
       "to which relative errors refer: |value|, or a part of usual values where the value vanishes; sums that cancel "
       "have the "
       "sizes of their terms",
       [](const GoalEstimate& g) { return number(g.scale); }},
      {"difference", "see unit",
       "estimate of the exact value minus value, from the solution of higher degree if there is one, else without the "
       "effect of the edges of contact zones",
       [](const GoalEstimate& g) { return number(g.difference()); }},
      {"corrected", "see unit", "value plus difference",
       [](const GoalEstimate& g) { return number(g.value + g.difference()); }},
      {"at_higher_degree", "see unit",
       "value on the same cells at degree k+1, if this solution was needed to confirm an accuracy, else null",
       [](const GoalEstimate& g) { return known(g.at_higher_degree); }},
      {"contact_edge", "see unit", "possible error by the edges of contact zones and by lifted bounds, of either sign",
       [](const GoalEstimate& g) { return number(g.contact_edge); }},
      {"error", "see unit", "estimate of |exact value - value|",
       [](const GoalEstimate& g) { return number(g.error()); }},
      {"geometry_error", "see unit",
       "estimated error by the mesh of the mid-surface; null on charts, and where it is unknown",
       [](const GoalEstimate& g) { return known(g.geometry_error); }},
      {"has_dual", "-", "true if the dual problem was solved; otherwise its part of the difference is missing",
       [](const GoalEstimate& g) { return Json(g.has_dual); }, Form::flag},
      {"dual_energy", "J",
       "energy of the dual solution per squared unit; if it grows with refinement, the number has no limit",
       [](const GoalEstimate& g) { return number(g.dual_energy); }},
  };
  return all;
}

std::span<const Quantity<certificate::Certificate>> certificate_quantities() {
  using certificate::Certificate;
  static const std::vector<Quantity<Certificate>> all{
      {"stationarity", "1", "residual on the free coordinates over loads and reactions",
       [](const Certificate& c) { return number(c.stationarity); }},
      {"min_pressure", "Pa", "smallest eta at a touching node",
       [](const Certificate& c) { return number(c.min_pressure); }},
      {"min_gap_nodes", "m", "smallest gap at a node; null without obstacle",
       [](const Certificate& c) { return number(c.min_gap_nodes); }},
      {"min_gap_between", "m", "smallest gap between nodes; null if no cell is near the obstacle",
       [](const Certificate& c) { return number(c.min_gap_between); }},
      {"support_error", "m",
       "largest deviation of a supported component from its prescribed value, rotations times the thickness",
       [](const Certificate& c) { return number(c.support_error); }},
      {"complementarity", "Pa m", "largest |eta g| at a node; where bounds are lifted, g is the gap minus the lift",
       [](const Certificate& c) { return number(c.complementarity); }},
      {"force_balance", "1", "sum of loads and reactions over the largest of them",
       [](const Certificate& c) { return number(c.force_balance); }},
      {"moment_balance", "1",
       "sum of moments about the origin over the largest of them; on curved shells it falls with the mesh size",
       [](const Certificate& c) { return number(c.moment_balance); }},
      {"energy_identity", "1", "|a(U, U) - work of loads and reactions| over a(U, U); null with finite rotations",
       [](const Certificate& c) { return number(c.energy_identity); }},
      {"energy_derivative", "1",
       "|derivative of the energy along (u, r) - work of the stresses along it| over that work; null with small "
       "rotations",
       [](const Certificate& c) { return number(c.energy_derivative); }},
  };
  return all;
}

std::span<const Quantity<computation::Level>> level_quantities() {
  using computation::Level;
  static const std::vector<Quantity<Level>> all{
      {"cells", "1", "cells of the mesh", [](const Level& l) { return Json(l.cells); }, Form::integer},
      {"nodes", "1", "nodes", [](const Level& l) { return Json(l.nodes); }, Form::integer},
      {"unknowns", "1", "unknowns, including supported ones", [](const Level& l) { return Json(l.unknowns); },
       Form::integer},
      {"time", "1", "time of the instant that was solved on it; 0 without steps",
       [](const Level& l) { return number(l.time); }},
      {"active", "1", "touching nodes", [](const Level& l) { return Json(l.active); }, Form::integer},
      {"iterations", "1", "active-set iterations", [](const Level& l) { return Json(l.iterations); }, Form::integer},
      {"factorisations", "1", "numeric factorisations", [](const Level& l) { return Json(l.factorisations); },
       Form::integer},
      {"linearisations", "1", "linearisations of the gaps of curved obstacles",
       [](const Level& l) { return Json(l.linearisations); }, Form::integer},
      {"lift_rounds", "1", "rounds in which bounds of gaps were lifted (contact.admissible)",
       [](const Level& l) { return Json(l.lift_rounds); }, Form::integer},
      {"gap_error", "m", "largest |distance - linearised gap| of the deformed faces in contact with curved obstacles",
       [](const Level& l) { return number(l.gap_error); }},
      {"status", "-", "how the computation on this mesh ended, in one word",
       [](const Level& l) { return Json(contact::to_string(l.status)); }, Form::text},
      {"energy", "J", "stored energy", [](const Level& l) { return number(l.energy); }},
      {"reaction", "N", "norm of the resultant force of the obstacles",
       [](const Level& l) { return number(l.reaction); }},
      {"contact_area", "m^2", "mid-surface area within the boundaries of the contact zones, summed over the obstacles",
       [](const Level& l) { return number(l.contact_area); }},
      {"max_normal_rotation", "1", "largest |r . a_3|", [](const Level& l) { return number(l.max_normal_rotation); }},
      {"multiplier_norm", "N m", "norm of the gradient of lambda",
       [](const Level& l) { return number(l.multiplier_norm); }},
      {"min_gap", "m", "smallest gap at a node; null without obstacle",
       [](const Level& l) { return number(l.min_gap); }},
      {"linear_residual", "1", "relative residual of the last linear solve",
       [](const Level& l) { return number(l.linear_residual); }},
      {"tolerances/bounds", "1", "tolerance of the bounds, over the largest displacement at contact nodes",
       [](const Level& l) { return number(l.tolerances.gap); }},
      {"tolerances/signs", "1", "tolerance of the signs of reactions, over the largest reaction",
       [](const Level& l) { return number(l.tolerances.multiplier); }},
      {"max_rotation", "rad", "largest |r|", [](const Level& l) { return number(l.max_rotation); }},
      {"seconds/mesh", "s", "refinement, numbering, transfer", [](const Level& l) { return number(l.seconds.mesh); }},
      {"seconds/discretisation", "s", "geometry, bounds, loads",
       [](const Level& l) { return number(l.seconds.discretisation); }},
      {"seconds/assembly", "s", "stiffness matrix", [](const Level& l) { return number(l.seconds.assembly); }},
      {"seconds/analysis", "s", "symbolic factorisation", [](const Level& l) { return number(l.seconds.analysis); }},
      {"seconds/factorisation", "s", "numeric factorisations",
       [](const Level& l) { return number(l.seconds.factorisation); }},
      {"seconds/iteration", "s", "active-set iteration without the factorisations",
       [](const Level& l) { return number(l.seconds.iteration); }},
      {"seconds/certificate", "s", "the certificate", [](const Level& l) { return number(l.seconds.certificate); }},
      {"seconds/estimates", "s", "estimates of errors", [](const Level& l) { return number(l.seconds.estimates); }},
      {"seconds/geometry", "s", "solution on a second surface, for meshes in space",
       [](const Level& l) { return number(l.seconds.geometry); }},
      {"seconds/witness", "s", "solution at degree k+1, if it was needed to confirm an accuracy",
       [](const Level& l) { return number(l.seconds.witness); }},
      {"seconds/total", "s", "sum of all times", [](const Level& l) { return number(l.seconds.total()); }},
  };
  return all;
}

std::span<const Quantity<computation::HistoryEntry>> history_quantities() {
  using computation::HistoryEntry;
  static const std::vector<Quantity<HistoryEntry>> all{
      {"time", "1", "number of completed steps, plus the completed part of the present one",
       [](const HistoryEntry& h) { return number(h.factors.time); }},
      {"step", "-", "name of the step", [](const HistoryEntry& h) { return Json(h.step); }, Form::text},
      {"status", "-", "how this instant ended, in one word",
       [](const HistoryEntry& h) { return Json(contact::to_string(h.status)); }, Form::text},
      {"load_factor", "1", "factor of all loads", [](const HistoryEntry& h) { return number(h.factors.loads); }},
      {"controlled_displacement", "m", "displacement that the loads follow; null without control",
       [](const HistoryEntry& h) {
         return h.controlled_displacement ? number(*h.controlled_displacement) : Json(nullptr);
       }},
      {"support_factor", "1", "factor of the values of supports and rigid bodies",
       [](const HistoryEntry& h) { return number(h.factors.supports); }},
      {"energy", "J", "stored energy, 1/2 a(U, U); W(U) with finite rotations",
       [](const HistoryEntry& h) { return number(h.summary.energy.total()); }},
      {"load_work", "J", "work of the loads, l(U)", [](const HistoryEntry& h) { return number(h.summary.load_work); }},
      {"max_displacement", "m", "largest |u| at a node",
       [](const HistoryEntry& h) { return number(h.summary.max_displacement); }},
      {"contact_area", "m^2", "mid-surface area within the boundaries of the contact zones, summed over the obstacles",
       [](const HistoryEntry& h) { return number(h.summary.contact_area); }},
      {"max_pressure", "Pa", "largest eta at a node",
       [](const HistoryEntry& h) { return number(h.summary.max_pressure); }},
      {"min_gap", "m", "smallest gap at a node", [](const HistoryEntry& h) { return number(h.level.min_gap); }},
      {"support_force", "N", "resultant force of all supports on the shell",
       [](const HistoryEntry& h) { return triple(h.summary.support_reaction.force); }, Form::triple},
      {"stability_margin", "1", "stability/margin at this instant; null with small rotations",
       [](const HistoryEntry& h) { return h.stability ? number(h.stability->margin) : Json(nullptr); }},
      {"has_jumped", "-",
       "with finite rotations: the shell snapped to this state, because a motion had no stiffness on the way",
       [](const HistoryEntry& h) { return Json(h.level.has_jumped); }, Form::flag},
      {"margin_without_weak_contact", "1", "stability/margin_without_weak_contact at this instant",
       [](const HistoryEntry& h) {
         return h.stability ? number(h.stability->margin_without_weak_contact) : Json(nullptr);
       }},
      {"margin_under_loads", "1", "stability/margin_under_loads at this instant; null without control",
       [](const HistoryEntry& h) {
         return h.stability && h.stability->margin_under_loads ? number(*h.stability->margin_under_loads)
                                                               : Json(nullptr);
       }},
      {"iterations", "1", "active-set iterations", [](const HistoryEntry& h) { return Json(h.level.iterations); },
       Form::integer},
      {"factorisations", "1", "numeric factorisations",
       [](const HistoryEntry& h) { return Json(h.level.factorisations); }, Form::integer},
      {"cells", "1", "cells of its mesh; with [accuracy] instants may have different meshes",
       [](const HistoryEntry& h) { return Json(h.level.cells); }, Form::integer},
      {"unknowns", "1", "unknowns on its mesh", [](const HistoryEntry& h) { return Json(h.level.unknowns); },
       Form::integer},
  };
  return all;
}

std::span<const Quantity<estimation::GoalRecord>> goal_record_quantities() {
  using estimation::GoalRecord;
  static const std::vector<Quantity<GoalRecord>> all{
      {"name", "-", "name of the number", [](const GoalRecord& g) { return Json(g.name); }, Form::text},
      {"error", "1", "estimated error, relative to the number or to the usual size of such numbers",
       [](const GoalRecord& g) { return number(g.relative_estimate()); }},
      {"tolerance", "1", "requested relative error", [](const GoalRecord& g) { return number(g.tolerance); }},
  };
  return all;
}

std::span<const Quantity<contact::Iteration>> iteration_quantities() {
  using contact::Iteration;
  static const std::vector<Quantity<Iteration>> all{
      {"active", "1", "unknowns at a bound", [](const Iteration& i) { return Json(i.active); }, Form::integer},
      {"changes", "1", "unknowns that entered or left the active set",
       [](const Iteration& i) { return Json(i.changes); }, Form::integer},
      {"energy", "J", "potential energy, 1/2 a(U, U) - l(U)", [](const Iteration& i) { return number(i.energy); }},
      {"worst_violation", "m", "largest violation of a bound",
       [](const Iteration& i) { return number(i.worst_violation); }},
      {"worst_multiplier", "N", "most negative reaction at a node",
       [](const Iteration& i) { return number(i.worst_multiplier); }},
      {"linear_steps", "1", "conjugate-gradient steps", [](const Iteration& i) { return Json(i.linear_steps); },
       Form::integer},
      {"safeguarded", "-", "true if the safeguarded search made this iteration",
       [](const Iteration& i) { return Json(i.safeguarded); }, Form::flag},
  };
  return all;
}

}  // namespace plastron::io
