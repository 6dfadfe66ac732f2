#include <plastron/computation/warnings.hpp>

#include <plastron/computation/relinearisation.hpp>
#include <plastron/meshing/sizes.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace plastron::computation {

namespace {

/// Error of the linear model that causes a warning.
constexpr double notable_model_error = 0.05;
/// Gap as a part of the thickness below which a shell without reactions lies on an obstacle.
constexpr double touching_without_force = 1e-3;
/// Ratio of membrane forces to the buckling forces. Above this value, thin shells with imperfections buckle.
constexpr double near_buckling = 0.5;
/// Margin of stability below which an equilibrium counts as nearly critical.
constexpr double near_critical = 0.05;
/// Strain above which measures of strain differ by more than 1 %; metals yield at a tenth of it.
constexpr double largest_strain = 0.02;
/// Share of transverse shear in the energy of a body that is no shell.
constexpr double largest_shear_part = 0.9;
/// Penetration between nodes that causes a warning, as a part of the thickness.
constexpr double notable_depth = 0.05;
/// Factor by which tolerances may be looser than requested without a warning.
constexpr double notable_loosening = 1e3;
/// Relative error by the mesh of the mid-surface that causes a warning where no accuracy is requested.
constexpr double notable_geometry_error = 0.01;

/// Returns "in the case "storm", " or "at time 1, ", which begins a sentence; "" without steps.
std::string instant_text(const problem::Problem& problem, const Result& result, double time) {
  const auto entry = std::ranges::find(result.history, time, [](const HistoryEntry& e) { return e.factors.time; });
  if (entry == result.history.end()) return "";
  return problem.steps_are_cases ? fmt::format("in the case \"{}\", ", entry->step)
                                 : fmt::format("at time {:g}, ", time);
}

/// Returns where the solution that was compared lies, and what to do.
std::string model_advice(const ModelCheck& check) {
  return fmt::format(
      "the displacement is up to {:.3g} thicknesses, the rotation up to {:.3g} rad; set rotations = \"finite\" in "
      "[shell]",
      check.relative_displacement, check.rotation);
}

std::string linear_model_text(const problem::Problem& problem, const Result& result) {
  const ModelCheck& check = *result.model;
  std::vector<std::string> numbers;
  for (const ModelQuantity& q : check.quantities)
    if (q.difference() > notable_model_error)
      numbers.push_back(fmt::format("{} {:.3g} {} and not {:.3g} {}", q.name, q.finite, q.unit, q.linear, q.unit));
  return fmt::format("{}the linear model is left: the model of finite rotations has, nearly, {}; {}",
                     instant_text(problem, result, result.model->time), fmt::join(numbers, ", "), model_advice(check));
}

std::string unstable_text(const problem::Problem& problem, const Result& result) {
  return fmt::format(
      "{}the linear model is left: with finite rotations the shell {}; it buckles or snaps through before; {}",
      instant_text(problem, result, result.model->time),
      result.model->status == contact::Status::solved ? "is not stable near this solution"
                                                      : "has no equilibrium near this solution",
      model_advice(*result.model));
}

std::string buckling_text(const std::string& when, double buckling) {
  return fmt::format(
      "{}the membrane forces are {:.2g} times those under which a perfect shell buckles, contact held, and real ones "
      "buckle from half of these on; the linear model knows no buckling; set rotations = \"finite\" in [shell], use a "
      "smaller load or a thicker shell",
      when, buckling);
}

std::string penetration_text(double depth, double part) {
  return fmt::format(
      "between its nodes the shell enters the obstacle by {:.2g} m, {:.0f} % of the thickness: no bound holds it "
      "there; refine the mesh, raise the degree or set admissible = true in [contact]",
      depth, 100 * part);
}

/// Limit below which a force counts as zero, relative to the sum of the norms of all nodal forces.
constexpr double negligible_force = 1e-6;

/// Whether there are six components, all at points: then statics alone determines their forces.
bool is_isostatic(const std::vector<assembly::Support>& supports) {
  std::size_t components = 0;
  for (const assembly::Support& support : supports) {
    if (!support.point) return false;
    components += support.components.size();
  }
  return components == 6;
}

/// Whether loads and the obstacle's reaction balance without the supports.
bool in_equilibrium(const solution::Summary& s) {
  solution::Wrench sum = s.loads;
  sum += s.reaction;
  sum += s.foundation_reaction();
  sum.move_point(-s.moment_point);  // back to the origin
  const double force = sum.force.norm(), moment = sum.moment.norm();
  return force <= negligible_force * s.force_scale() && moment <= negligible_force * s.force_scale() * s.size;
}

/// Limit of the size h (e/L)^{-1/k} / L, at which locking costs a tenth of the deflection, measured for degree 1 to 3
/// (docs/methods/triangles.md). The reason: the membrane and shear strains of a cell can only follow a bending to order
/// h^k. The cell's energy is too large by (h^k / (e L^{k-1}))^2. Higher degrees did not lock on meshes of practical
/// size.
constexpr std::array<double, 3> largest_size = {0.7, 1.3, 1.7};

/// Returns a warning if lifts of bounds (admissible) change much of the energy.
void lift_warnings(const Result& result, std::vector<std::string>& warnings) {
  constexpr double notable = 0.1;
  const solution::Summary& s = result.summary;
  if (!s.is_admissible_wanted || result.levels.empty() || s.is_unstrained) return;
  const Level& level = result.last_level();
  const double larger = std::max(std::abs(level.energy), std::abs(level.energy_before_lifts));
  const double part = larger > 0 ? std::abs(level.energy - level.energy_before_lifts) / larger : 0;
  if (!(part > notable)) return;
  warnings.push_back(
      fmt::format("admissible = true lifts bounds at nodes by up to {:.2g} m, which changes the energy by {:.0f} %; "
                  "refine the mesh "
                  "or raise the degree",
                  s.largest_lift, 100 * part));
}

/// Returns one warning for each obstacle that the shell touches along lines inside.
void line_contact_warnings(const solution::Summary& summary, std::vector<std::string>& warnings) {
  constexpr double notable = 0.01;  // part of the obstacle's reaction
  for (const solution::ObstacleContact& obstacle : summary.obstacles) {
    double force = 0, per_length = 0;
    for (const solution::ContactZone& zone : obstacle.zones) {
      if (!zone.is_line()) continue;
      force += zone.reaction.force.norm();
      per_length = std::max(per_length, zone.line_reaction());
    }
    if (!(force > notable * obstacle.force_norms)) continue;
    warnings.push_back(fmt::format(
        "the shell touches {} along lines or in points that are narrower than the distance of nodes: they carry "
        "{:.4g} N{}; the pressure (eta) at their nodes depends on the mesh",
        obstacle.name.empty() ? "the obstacle" : "\"" + obstacle.name + "\"", force,
        per_length > 0 ? fmt::format(", up to {:.4g} N/m", per_length) : ""));
  }
}

/// Nodes that were deep inside an obstacle and were pushed out along the shell instead of across it. Their nearest surface at the
/// start may have been the wrong one.
void sideways_warnings(const solution::Summary& summary, std::vector<std::string>& warnings) {
  for (const solution::ObstacleContact& obstacle : summary.obstacles) {
    const std::int64_t count = obstacle.sideways_nodes;
    if (count == 0) continue;
    warnings.push_back(
        fmt::format("{} {} deep inside of {} at the start {} pushed out of it sideways, along the shell: the surface "
                    "nearest to a point inside of a body need not be the one that the shell meets; let the obstacle "
                    "come in by [[step]]s, round its edges or refine the mesh",
                    count, count == 1 ? "node" : "nodes",
                    obstacle.name.empty() ? "the obstacle" : "\"" + obstacle.name + "\"", count == 1 ? "was" : "were"));
  }
}

/// The model of finite rotations has other numbers or no stable solution nearby, or the shell would buckle.
void linear_model_warnings(const problem::Problem& problem, const Result& result, std::vector<std::string>& warnings) {
  if (result.model) {
    const std::string word = word_of(*result.model);
    if (word == "unstable" || word == "no_solution")
      warnings.push_back(unstable_text(problem, result));
    else if (result.model->largest() > notable_model_error)
      warnings.push_back(linear_model_text(problem, result));
  }
  const bool lacks_contact =
      result.status == contact::Status::gap_not_met || result.status == contact::Status::inaccurate;
  if (lacks_contact && result.summary.max_rotation > meaningless_rotation)
    warnings.push_back(
        fmt::format("the linear model turns the shell by {:.2g} rad, and no gap means anything there; correct E, the "
                    "loads or their units",
                    result.summary.max_rotation));
  double buckling = result.levels.empty() ? 0 : result.last_level().buckling.value_or(0);
  std::string when;
  for (const HistoryEntry& instant : result.history)
    if (instant.level.status == contact::Status::solved && instant.level.buckling.value_or(0) >= buckling) {
      buckling = instant.level.buckling.value_or(0);
      when = instant_text(problem, result, instant.factors.time);
    }
  if (buckling > near_buckling) warnings.push_back(buckling_text(when, buckling));
}

/// Snaps between states with finite rotations. Where the program has divided the way, more parts do not help.
void jump_warnings(const problem::Problem& problem, const Result& result, std::vector<std::string>& warnings) {
  // The way from the start, and a step that chooses its parts, were divided before a jump was accepted (step_control.hpp).
  const auto is_divided = [&](const HistoryEntry& instant) {
    const auto step = std::ranges::find(problem.steps, instant.step, &problem::Step::name);
    return &instant == &result.history.front() || (step != problem.steps.end() && step->chooses_parts);
  };
  std::string snaps, jumps;
  for (const HistoryEntry& instant : result.history)
    if (instant.level.has_jumped) {
      std::string& when = is_divided(instant) ? snaps : jumps;
      when += fmt::format("{}{:g}", when.empty() ? " at time " : ", ", instant.factors.time);
    }
  const bool is_single = result.history.empty();  // its first mesh goes the way from the start
  const bool has_snapped = is_single ? !result.levels.empty() && result.levels.front().has_jumped : !snaps.empty();
  const bool has_jumped =
      is_single ? !has_snapped && std::ranges::any_of(result.levels, &Level::has_jumped) : !jumps.empty();
  if (has_snapped)
    warnings.push_back(fmt::format(
        "the shell snaps to another equilibrium{}: a motion lost its stiffness during the iteration, also where the "
        "program divided the way, and shorter ones do not help; the shell need not come to rest there in time; "
        "`control` in a [[step]] follows the equilibria through a snap of loads",
        snaps));
  if (has_jumped)
    warnings.push_back(fmt::format(
        "the shell jumps to another equilibrium{}: during the iteration a motion lost its stiffness; it need not "
        "be the equilibrium that follows in time; parts = \"auto\" in a [[step]] shows whether the shell snaps, "
        "and where",
        jumps));
}

/// The loads do not move the displacement that is to control them.
void control_warnings(const Result& result, std::vector<std::string>& warnings) {
  const auto is_blind = [](const HistoryEntry& entry) { return entry.level.is_control_blind; };
  if (!std::ranges::any_of(result.levels, &Level::is_control_blind) && !std::ranges::any_of(result.history, is_blind))
    return;
  warnings.emplace_back(
      "the loads do not move the controlled displacement, or a support or an obstacle holds it; choose another probe "
      "or direction in `control`");
}

/// Equilibria with finite rotations that are nearly critical, or stable only because of weak contact.
void stability_warnings(const Result& result, std::vector<std::string>& warnings) {
  if (!result.stability || result.status == contact::Status::unstable) return;
  const finite::Stability& s = *result.stability;
  if (s.margin_under_loads && !(*s.margin_under_loads > 0))
    warnings.emplace_back(
        "the equilibrium holds only as long as the displacement is controlled: under these loads alone the shell snaps "
        "away (margin_under_loads)");
  if (s.margin < near_critical)
    warnings.push_back(fmt::format(
        "the equilibrium is nearly critical: a motion has {:.2g} of the stiffness that the shell has without "
        "stresses (softest_motion in solution.vtu); a little more load, or an imperfection, may make it snap",
        s.margin));
  else if (s.weak_nodes > 0 && !(s.margin_without_weak_contact > 0))
    warnings.push_back(
        fmt::format("weak contact holds the equilibrium: without the {} nodes whose pressure is below {:g} of the "
                    "largest, some motion would lower the energy; a small disturbance may make the shell snap away",
                    s.weak_nodes, finite::Stability::weak_part));
}

/// Loads whose expressions are 0 at all points of the mesh.
void load_warnings(const problem::Problem& problem, const Result& result, std::vector<std::string>& warnings) {
  const auto is_loaded = [](const fem::RigidBody& body) { return !body.force.isZero(0) || !body.moment.isZero(0); };
  const energy::Factors& factors = result.solution->discrete->state.factors;
  if (result.summary.load_norms != 0 || factors.loads == 0 ||
      std::ranges::any_of(factors.named, [](double own) { return own == 0; }) ||
      std::ranges::any_of(problem.rigid_bodies, is_loaded))
    return;
  std::string name;
  problem.shell.loads.for_each_expression(
      [&](const geometry::Expression& f, const std::string& of, const energy::LoadPlace&) {
        if (name.empty() && !f.is_constant()) name = of;
      });
  if (name.empty()) return;
  warnings.push_back(
      fmt::format("the shell has no load: {} and all other loads are 0 at all points of the mesh where forces are "
                  "summed; correct the places in their expressions, or refine the mesh there",
                  name));
}

/// Strains beyond the range of the linear material law.
void strain_warnings(const problem::Problem& problem, const Result& result, std::vector<std::string>& warnings) {
  double strain = result.summary.max_strain;
  std::string when, stress;
  if (const Eigen::Vector3d& at = result.peak.position; result.peak.von_mises > 0)
    stress = fmt::format(", the largest von Mises stress {:.4g} Pa at ({:.4g}, {:.4g}, {:.4g}) m",
                         result.peak.von_mises, at[0], at[1], at[2]);
  for (const HistoryEntry& instant : result.history)  // the last one is that of the stress
    if (instant.summary.max_strain > (1 + 1e-9) * strain) {
      strain = instant.summary.max_strain;
      when = instant_text(problem, result, instant.factors.time);
      stress.clear();
    }
  if (!(strain > largest_strain)) return;
  warnings.push_back(
      fmt::format("{}the largest strain is {:.2g} %{}: most metals yield at strains of 0.1 to 0.5 %, and the law is "
                  "linear; compare "
                  "stresses with the yield stress, use a smaller load or a program with plasticity",
                  when, 100 * strain, stress));
}

/// A share of transverse shear that no shell has.
void shear_warnings(const Result& result, std::vector<std::string>& warnings) {
  const energy::Energies& energy = result.summary.energy;
  const double part = energy.shear / energy.total();
  if (result.summary.is_unstrained || !(part > largest_shear_part)) return;
  warnings.push_back(fmt::format(
      "{:.3g} % of the energy is transverse shear, and no shell deforms like this: obstacles or supports leave less "
      "room "
      "than its thickness, it is nearly as thick as it is wide, or a core is too soft for one director; check the "
      "obstacles, and use a model of solids where the case is meant",
      100 * part));
}

/// Strains at the first buckling load that are too large for a linear law: such modes are as short as the cells.
void mode_warnings(const Result& result, std::vector<std::string>& warnings) {
  constexpr double meaningless = 0.3;
  const auto first = std::ranges::find(result.modes, Mode::Kind::buckling, &Mode::kind);
  if (first == result.modes.end() || !(first->value * result.summary.max_strain > meaningless)) return;
  warnings.push_back(fmt::format(
      "at the first buckling load the strains would be {:.2g} %: material fails before the shell buckles, and the "
      "shapes of such modes depend on the mesh",
      100 * first->value * result.summary.max_strain));
}

/// The mesh of the file causes larger errors than asked for or than the discretisation.
void geometry_warnings(const Result& result, std::vector<std::string>& warnings) {
  if (!result.estimates || !result.estimates->geometry) return;
  const auto excess = [](const estimation::GoalEstimate& goal) {
    const double allowed = goal.tolerance.value_or(notable_geometry_error) * goal.scale;
    return allowed > 0 ? goal.geometry_error.value_or(0) / allowed : 0;
  };
  const auto& goals = result.estimates->goals;
  const auto worst = std::ranges::max_element(goals, {}, excess);
  if (worst == goals.end() || !(excess(*worst) > 1)) return;
  const estimation::GeometryDeviation& mesh = *result.estimates->geometry;
  warnings.push_back(
      fmt::format("the mesh of the file limits the accuracy: {} changes by {:.2g} % if the cells are fitted to their "
                  "neighbours; the mesh deviates from the part by about {:.2g} m at ({:.4g}, {:.4g}, {:.4g}) m; export "
                  "cells of a higher order, or smaller ones",
                  worst->name, 100 * *worst->geometry_error / worst->scale, mesh.largest, mesh.place[0], mesh.place[1],
                  mesh.place[2]));
}

/// Rigid bodies that move their nodes into obstacles.
void body_warnings(const solution::Summary& summary, std::vector<std::string>& warnings) {
  for (const solution::BodyReaction& body : summary.body_reactions)
    if (-body.least_gap > notable_depth * summary.least_thickness)
      warnings.push_back(fmt::format(
          "the rigid body \"{}\" takes the shell {:.2g} m into an obstacle: nothing holds the nodes of a body "
          "out of obstacles; fix the body where the obstacle would, or let it carry an edge that stays out",
          body.name, -body.least_gap));
}

/// Obstacles that the shell touches at no instant.
void idle_warnings(const Result& result, std::vector<std::string>& warnings) {
  const auto touches = [](const HistoryEntry& instant) { return instant.summary.touching_nodes > 0; };
  const std::vector<solution::ObstacleContact>& obstacles = result.summary.obstacles;
  if (result.status != contact::Status::solved || obstacles.empty() || result.summary.touching_nodes > 0 ||
      std::ranges::any_of(result.history, touches))
    return;
  const auto nearest = std::ranges::min_element(obstacles, {}, &solution::ObstacleContact::least_gap);
  const bool is_searched = std::isfinite(nearest->least_gap);  // near cells only, and no bed
  const double gap = is_searched ? nearest->least_gap : result.certificate.min_gap_nodes;
  if (gap < touching_without_force * result.summary.least_thickness) return;
  const std::string place =
      is_searched ? fmt::format(" at {}", nearest->least_gap_place) : " at the nodes that can move";
  warnings.push_back(
      fmt::format("the shell touches no obstacle: the smallest gap is {:.3g} m{}{}; check the signs and sizes of the "
                  "loads, and on which side of the shell the obstacle lies",
                  gap, place, result.history.empty() ? "" : " in the end"));
}

/// Penetration between nodes, lifts that change much of the energy, reactions concentrated on edges, and tolerances that
/// rounding has loosened.
void contact_warnings(const Result& result, const contact::Settings& asked, std::vector<std::string>& warnings) {
  const solution::Summary& s = result.summary;
  const double depth = -result.certificate.min_gap_between, part = depth / s.least_thickness;
  if (std::isfinite(depth) && s.touching_nodes > 0 && part > notable_depth)
    warnings.push_back(penetration_text(depth, part));
  lift_warnings(result, warnings);
  if (s.edge.is_line())
    warnings.push_back(
        fmt::format("the shell stands on its edge: {:.4g} N of the reaction are concentrated on it, up to {:.4g} N/m; "
                    "the pressure (eta) at nodes of that edge depends on the mesh",
                    s.edge.force, s.edge.max_per_length));
  else
    line_contact_warnings(s, warnings);
  if (result.levels.empty()) return;
  const contact::Tolerances& used = result.levels.back().tolerances;
  if (used.gap > notable_loosening * asked.gap_tolerance ||
      used.multiplier > notable_loosening * asked.multiplier_tolerance)
    warnings.push_back(fmt::format(
        "rounding has loosened the tolerances of contact: gaps are closed to {:.1g} of the largest displacement at "
        "contact nodes, signs of reactions hold to {:.1g} of the largest (asked: {:.1g} and {:.1g})",
        used.gap, used.multiplier, asked.gap_tolerance, asked.multiplier_tolerance));
}

/// Probes at places where stresses have no limit or a peak.
void probe_warnings(const Result& result, std::vector<std::string>& warnings) {
  // Displacements and rotations have no peak there.
  const auto asks_for_resultants = [&](const ProbeValue& probe) {
    const std::string prefix = "probe." + probe.name + ".";
    return result.estimates && std::ranges::any_of(result.estimates->goals, [&](const auto& goal) {
             return goal.name.starts_with(prefix) &&
                    std::string_view("NMQs").find(goal.name[prefix.size()]) != std::string_view::npos;
           });
  };
  for (const ProbeValue& probe : result.probes)
    for (const recovery::SingularPlace& place : result.singular_places)
      if (place.is_near(probe.values.phi) && asks_for_resultants(probe)) {
        warnings.push_back(
            fmt::format("the probe \"{}\" lies within {:.2g} m of a {}: moments, forces and stresses there have a peak "
                        "that depends on the "
                        "mesh; no estimate covers them; move the probe away, or refine the mesh and compare",
                        probe.name, place.radius, place.what));
        break;
      }
}

/// Forces that supports carry at points: a shell fixed at three points against its rigid motions needs none if its loads
/// are in equilibrium. A remaining force has no limit as the mesh is refined (docs/model.md, section 6).
/// One warning for the point with the largest reaction, if this is above a millionth of the loads.
void point_support_warnings(const Result& result, const std::vector<assembly::Support>& supports,
                            std::vector<std::string>& warnings) {
  const solution::Summary& s = result.summary;
  const bool is_solved = result.status == contact::Status::solved || result.status == contact::Status::inaccurate;
  if (!is_solved || s.point_reactions.empty() || s.is_unstrained) return;
  const auto most = std::ranges::max_element(
      s.point_reactions, {}, [](const solution::PointReaction& reaction) { return reaction.force.norm(); });
  const double force = most->force.norm();
  if (force <= negligible_force * s.force_scale()) return;
  const std::string what = fmt::format("the support at the point {} carries {:.4g} N",
                                       s.is_in_space ? fmt::format("({:.6g})", fmt::join(most->position, ", "))
                                                     : fmt::format("({:.6g})", fmt::join(most->at, ", ")),
                                       force);
  warnings.push_back(
      what +
      (is_isostatic(supports) && in_equilibrium(s)
           ? fmt::format(
                 ", {:.1g} of the loads, though these are in equilibrium: on a curved shell the mesh misses so much "
                 "of a rigid rotation; refine it or raise the degree",
                 force / s.force_scale())
           : ": a force at a point is singular in this model, the displacement under it grows without limit as the "
             "mesh is "
             "refined; let the loads be in equilibrium, so that points hold the rigid motions alone, or support a "
             "boundary"));
}

}  // namespace

std::vector<std::string> locking_warnings(const problem::Problem& problem) {
  const problem::Discretisation& d = problem.discretisation;
  const bool is_tied = problem.shell.tying && d.cells == mesh::Shape::quadrilateral;
  if (is_tied || d.degree > static_cast<int>(largest_size.size())) return {};
  const double L = meshing::extent(problem);
  double worst = 0, size = 0, limit = 0, thickness = 0;
  for (const auto& [h, e] : meshing::cell_sizes(problem)) {
    const double allowed = largest_size[static_cast<std::size_t>(d.degree - 1)] * L * std::pow(e / L, 1.0 / d.degree);
    if (h / allowed <= worst) continue;
    worst = h / allowed;
    size = h;
    limit = allowed;
    thickness = e;
  }
  if (worst <= 1) return {};
  const bool triangles = d.cells == mesh::Shape::triangle;
  return {
      fmt::format("{} of degree {} without tying are likely to lock: sides of the finest mesh are up to {:.3g} m long, "
                  "{:.3g} times the thickness, and displacements in bending come out more than 10 % too small from "
                  "about {:.2g} m on; {}, or refine {} more time{}",
                  triangles ? "triangles" : "quadrilaterals", d.degree, size, size / thickness, limit,
                  triangles ? (d.degree == 1 ? "take cells = \"quadrilateral\" with tying, or degree 2"
                                             : "take cells = \"quadrilateral\" with tying")
                            : "set tying = true",
                  std::ceil(std::log2(worst)), worst > 2 ? "s" : "")};
}

std::vector<std::string> state_warnings(const problem::Problem& problem, const Result& result) {
  std::vector<std::string> warnings;
  load_warnings(problem, result, warnings);
  linear_model_warnings(problem, result, warnings);
  jump_warnings(problem, result, warnings);
  control_warnings(result, warnings);
  stability_warnings(result, warnings);
  geometry_warnings(result, warnings);
  idle_warnings(result, warnings);
  contact_warnings(result, problem.contact, warnings);
  sideways_warnings(result.summary, warnings);
  body_warnings(result.summary, warnings);
  point_support_warnings(result, problem.shell.supports, warnings);
  probe_warnings(result, warnings);
  return warnings;
}

std::vector<std::string> material_warnings(const problem::Problem& problem, const Result& result) {
  std::vector<std::string> warnings;
  mode_warnings(result, warnings);
  strain_warnings(problem, result, warnings);
  shear_warnings(result, warnings);
  return warnings;
}

}  // namespace plastron::computation
