#include "progress.hpp"

#include "console.hpp"
#include "terminal.hpp"

#include <plastron/computation/warnings.hpp>
#include <plastron/geometry/quotation.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/goal_names.hpp>
#include <plastron/problem/instants.hpp>
#include <plastron/topology/space_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace plastron::app {

Progress::Progress(const problem::Problem& problem, bool quiet)
    : has_obstacle_(!problem.shell.obstacles.empty()),
      quiet_(quiet),
      is_by_accuracy_(problem.accuracy.has_value()),
      status_(quiet),
      meshes_(problem.discretisation.refinements + 1),
      number_of_parts_(static_cast<int>(problem::instants(problem).size())),
      chooses_parts_(std::ranges::any_of(problem.steps, &problem::Step::chooses_parts)),
      meshes_left_(meshes_) {
  if (!quiet_) print_header(problem);
}

namespace {

/// Returns the width of a goal's name above its estimates.
std::size_t width_of(const std::string& name) { return std::max<std::size_t>(9, geometry::shortened(name, 24).size()); }

}  // namespace

void Progress::print_header(const problem::Problem& problem) const {
  if (!is_by_accuracy_) {
    print("{:>5} {:>9} {:>10} {:>8} {:>6} {:>12} {:>16} {:>9}\n", "level", "cells", "unknowns", "contact", "steps",
          with_unit_names("min gap [m]"), with_unit_names("energy [J]"), "time [s]");
    return;
  }
  print("{:>5} {:>9} {:>10} {:>8} {:>6} {:>9}  estimated errors, relative\n", "mesh", "cells", "unknowns", "contact",
        "steps", "time [s]");
  std::string names, asked;
  for (const estimation::Goal& goal : problem::estimated_goals(problem)) {
    names += fmt::format("  {:>{}}", geometry::shortened(goal.name, 24), width_of(goal.name));
    asked += fmt::format("  {:>{}.1e}", goal.tolerance.value_or(0), width_of(goal.name));
  }
  print("{:>52}{}\n{:>52}{}\n", "", names, "asked for", asked);
}

void Progress::print_goals(int level, const computation::Level& r) const {
  print("{:>5} {:>9} {:>10} {:>8} {:>6} {:>9.2f}", level, r.cells, r.unknowns, r.active, r.iterations,
        r.seconds.total());
  for (const estimation::GoalRecord& goal : r.goals)
    print("  {:>{}}", goal.has_estimate ? fmt::format("{:.1e}", goal.relative_estimate()) : "-", width_of(goal.name));
  print("{}\n", r.status == contact::Status::solved ? "" : fmt::format("  {}", contact::to_string(r.status)));
}

computation::Observer Progress::observer() {
  return {.phase = [this](int l, std::string_view name) { phase(l, name); },
          .iteration = [this](int l, const contact::Iteration& i) { iteration(l, i); },
          .level = [this](int l, const computation::Level& record) { level(l, record); },
          .solution = {},
          .stop = is_interrupted};
}

std::string Progress::place(int level) const {
  if (parts_ && chooses_parts_) return fmt::format("part {}", parts_->number_done() + 2);
  if (parts_) return fmt::format("part {} of {}", parts_->number_done() + 2, number_of_parts_);
  if (!is_by_accuracy_) return fmt::format("level {} of {}", level, meshes_ - 1);
  return most_missed_ > 1 ? fmt::format("mesh {}, errors up to {:.2g} times their tolerances", level, most_missed_)
                          : fmt::format("mesh {}", level);
}

void Progress::phase(int level, std::string_view name) {
  if (level != last_level_) log_event("level_begin", {{"level", level}});
  last_level_ = level;
  log_event("phase", {{"level", level}, {"phase", name}});
  iterations_ = 0;
  status_.show(fmt::format("{}: {} ...", place(level), name), end());
}

void Progress::iteration(int level, const contact::Iteration& i) {
  ++iterations_;
  if (is_logging_events()) {
    Details details{{"level", level}, {"iteration", iterations_}};
    details.update(io::record_json(io::iteration_quantities(), i));
    log_event("iteration", details);
  }
  status_.show(
      fmt::format("{}: step {}, {} nodes in contact, {} changed", place(level), iterations_, i.active, i.changes),
      end());
}

void Progress::level(int level, const computation::Level& r) {
  status_.clear();
  log_level(level, r);
  most_missed_ = 0;
  for (const estimation::GoalRecord& goal : r.goals) most_missed_ = std::max(most_missed_, goal.excess());
  if (!is_by_accuracy_) meshes_left_.done(status_.seconds());
  if (!is_by_accuracy_ && level == meshes_ - 1 && number_of_parts_ > 1)
    parts_.emplace(number_of_parts_ - 1, status_.seconds());
  if (quiet_) return;
  if (is_by_accuracy_) {
    print_goals(level, r);
    if (is_first_rank()) std::fflush(stdout);
    return;
  }
  const std::string gap = has_obstacle_ ? fmt::format("{:.3e}", r.min_gap) : "-";
  print("{:>5} {:>9} {:>10} {:>8} {:>6} {:>12} {:>16.9e} {:>9.2f}{}\n", level, r.cells, r.unknowns, r.active,
        r.iterations, gap, r.energy, r.seconds.total(),
        r.status == contact::Status::solved ? "" : fmt::format("  {}", contact::to_string(r.status)));
  if (is_first_rank()) std::fflush(stdout);
}

void Progress::instant(const computation::HistoryEntry& entry) {
  status_.clear();
  if (is_logging_events()) log_event("instant", io::record_json(io::history_quantities(), entry));
  if (parts_ && has_seen_instant_) parts_->done(status_.seconds());  // the first instant belongs to the meshes
  has_seen_instant_ = true;
  if (quiet_) return;
  // Each obstacle's own force is printed, because the forces of obstacles that press against each other cancel in the
  // sum.
  constexpr std::size_t most_obstacles = 4;
  const auto obstacles =
      std::span(entry.summary.obstacles).first(std::min(entry.summary.obstacles.size(), most_obstacles));
  if (!has_instants_) {
    print("\n{:>9} {:<20} {:>7} {:>8} {:>6} {:>16} {:>16} {:>8}", "time", "step", "loads", "contact", "steps",
          with_unit_names("max |u| [m]"), with_unit_names("energy [J]"), "|u| / e");
    for (const auto& obstacle : obstacles)
      print(" {:>18}",
            (obstacles.size() == 1 ? "obstacle" : geometry::shortened(obstacle.name, 14)) + with_unit_names(" [N]"));
    print("{}\n", entry.summary.obstacles.size() > most_obstacles ? "  others: history.csv" : "");
  }
  has_instants_ = true;
  print("{:>9.4g} {:<20} {:>7.3g} {:>8} {:>6} {:>16.6e} {:>16.9e} {:>8.2g}", entry.factors.time,
        geometry::shortened(entry.step, 20), entry.factors.loads, entry.level.active, entry.level.iterations,
        entry.summary.max_displacement, entry.summary.energy.total(), entry.summary.max_relative_displacement);
  for (const auto& obstacle : obstacles) print(" {:>18.6e}", obstacle.reaction.force.norm());
  print("{}\n", entry.status == contact::Status::solved ? "" : fmt::format("  {}", contact::to_string(entry.status)));
  if (is_first_rank()) std::fflush(stdout);
}

namespace {

std::string vector_text(const Eigen::Vector3d& v) { return fmt::format("({:.6e}, {:.6e}, {:.6e})", v[0], v[1], v[2]); }

/// Prints one line for each contact zone if there are several, but not many.
void print_zones(const std::vector<solution::ObstacleContact>& obstacles) {
  constexpr std::size_t most = 10;
  std::size_t all = 0, printed = 0;
  for (const auto& o : obstacles) all += o.zones.size();
  if (all < 2) return;
  for (const auto& o : obstacles)
    for (std::size_t k = 0; k < o.zones.size() && printed < most; ++k, ++printed) {
      const auto& zone = o.zones[k];
      const std::string name = obstacles.size() == 1 ? fmt::format("  zone {}", k) : fmt::format("  {}, {}", o.name, k);
      print("{:<17} {} nodes, {:.6e} m^2, {:.6e} N at ({:.4g}, {:.4g}, {:.4g}) m\n", name, zone.nodes, zone.area,
            zone.reaction.force.norm(), zone.centre[0], zone.centre[1], zone.centre[2]);
    }
  if (all > most) print("  ... and {} more zones\n", all - most);
}

/// Prints the effect of keeping the shell outside the obstacles between its nodes.
void print_lifts(const computation::Result& result) {
  if (!result.summary.is_admissible_wanted) return;
  const computation::Level& level = result.last_level();
  const double change = level.energy - level.energy_before_lifts;
  print("admissible        {} rounds lifted bounds of gaps by up to {:.2e} m and changed the energy by {:.2e} J\n",
        level.lift_rounds, result.summary.largest_lift, change);
}

constexpr double nearly_all = 0.95;  // of the area, judged

/// Returns ", by the mesh of the file 0.2 %"; empty where this error is unknown.
std::string geometry_text(const estimation::GoalEstimate& goal) {
  const auto error = goal.geometry_error;
  return error ? fmt::format(", by the mesh of the file {:.2g} %,", 100 * *error / std::abs(goal.value)) : "";
}

/// Prints estimated errors, relative to the numbers themselves. Where a number vanishes, because terms cancel or the shell is at
/// rest, it prints the error itself.
void print_estimates(const computation::Result& result) {
  if (!result.estimates) return;
  for (const estimation::GoalEstimate& g : result.estimates->goals)
    if (g.scale > 2 * std::abs(g.value))
      print("estimated error   {} {:.2g} {}; its value {:.2g} {} vanishes\n", g.name, g.error(), g.unit, g.value,
            g.unit);
    else if (g.value != 0)
      print("estimated error   {} {:.2g} %{} of {:.6e} {}\n", g.name, 100 * g.error() / std::abs(g.value),
            geometry_text(g), g.value, g.unit);
  if (result.estimates->unjudged_cells > 0)
    print("                  too small in {} cells, which have no neighbours for comparison\n",
          result.estimates->unjudged_cells);
  const auto& geometry = result.estimates->geometry;
  if (geometry && geometry->judged_share == 0)
    print("                  the error by the mesh, or by the facets, of the file is not estimated\n");
  else if (geometry && geometry->judged_share < nearly_all)
    print("                  the mesh of the file cannot be judged on {:.2g} % of the area: its cells are too coarse\n",
          100 * (1 - geometry->judged_share));
}

/// Returns the value with the digits that the estimated error permits, at least three.
std::string with_known_digits(double value, double error) {
  const double part = value != 0 ? std::abs(error / value) : 1;
  const int digits = std::isfinite(part) && part > 0 ? static_cast<int>(std::ceil(-std::log10(part))) : 4;
  return fmt::format("{:.{}g}", value, std::clamp(digits, 3, 6));
}

void print_stress(const computation::Result& result) {
  const recovery::StressPeak& peak = result.peak;
  print("                  von Mises stress {} Pa at ({:.4g}, {:.4g}, {:.4g}) m, z = {:.3g} m{}\n",
        with_known_digits(peak.von_mises, peak.error), peak.position[0], peak.position[1], peak.position[2],
        peak.height,
        std::isfinite(peak.error) && peak.von_mises > 0
            ? fmt::format(", estimated error {:.2g} %", 100 * peak.error / peak.von_mises)
            : "");
  constexpr std::size_t most = 4;
  if (result.singular_places.empty()) return;
  print("                  without these places, where stresses have no limit:\n");
  for (std::size_t i = 0; i < std::min(most, result.singular_places.size()); ++i) {
    const recovery::SingularPlace& place = result.singular_places[i];
    print("                    {} at ({:.4g}, {:.4g}, {:.4g}) m\n", place.what, place.position[0], place.position[1],
          place.position[2]);
  }
  if (result.singular_places.size() > most)
    print("                    and {} more (singular_places in results.json)\n", result.singular_places.size() - most);
}

/// Prints the range of each in-plane stress of each layer, in its own axes.
void print_layers(const computation::Result& result) {
  constexpr std::size_t most = 8, components = 5;
  const auto range = [](const recovery::LayerStress& s) {
    return fmt::format("{:.3g} to {:.3g}", s.least.stress, s.most.stress);
  };
  for (std::size_t i = 0; i + components <= std::min(result.layers.size(), most * components); i += components) {
    const recovery::LayerStress& first = result.layers[i];
    print("{:<18}{}{} at {:g} deg: stress 11 {}, 22 {} Pa\n", i == 0 ? "layers" : "",
          first.region.empty() ? "" : first.region + " ", first.layer, first.angle, range(first),
          range(result.layers[i + 1]));
  }
  if (result.layers.size() > most * components)
    print("                  and {} more (layers in results.json)\n", result.layers.size() / components - most);
}

/// Prints the numbers of the linear model whose error is largest, and the distance from buckling.
/// Returns a part as per cent, as long as this is meaningful.
std::string percent(double part) {
  if (!(part < 10)) return "more than 1000 %";
  return part < 0.1 ? fmt::format("{:.2g} %", 100 * part) : fmt::format("{:.0f} %", 100 * part);
}

void print_linearity(const computation::Result& result) {
  if (result.model) {
    const std::string word = computation::word_of(*result.model);
    print("linear model      ");
    if (word == "unknown")
      print("the comparison with finite rotations failed\n");
    else if (word == "solved")
      print("with finite rotations numbers change by {}\n", percent(result.model->largest()));
    else
      print("with finite rotations the shell {}\n",
            word == "unstable" ? "is not stable near this solution" : "has no equilibrium near this solution");
    for (const computation::ModelQuantity& q : result.model->quantities)
      if (q.linear != 0 || q.finite != 0)
        print("                  {} {:.4g} {}, linear {:.4g} ({})\n", q.name, q.finite, q.unit, q.linear,
              percent(q.difference()));
  }
  if (const auto& buckling = result.last_level().buckling; buckling.value_or(0) > 0)
    print("                  membrane forces are {:.2g} times the buckling load\n", *buckling);
}

/// Prints the margin of stability of an equilibrium with finite rotations.
void print_stability(const computation::Result& result) {
  if (!result.stability) return;
  const finite::Stability& s = *result.stability;
  print("stability         margin {:.3g} (1 without stresses, 0 where it snaps)", s.margin);
  if (s.weak_nodes > 0) print(", {:.3g} without {} nodes in weak contact", s.margin_without_weak_contact, s.weak_nodes);
  if (s.margin_under_loads) print(", {:.3g} if the loads stay", *s.margin_under_loads);
  print("\n");
}

/// Prints load factors and natural frequencies.
void print_modes(const std::vector<computation::Mode>& modes) {
  using Kind = computation::Mode::Kind;
  for (const Kind kind : {Kind::buckling, Kind::vibration}) {
    std::string numbers;
    for (const computation::Mode& mode : modes) {
      if (mode.kind != kind) continue;
      numbers += numbers.empty() ? "" : ", ";
      numbers += kind == Kind::buckling ? fmt::format("{:.5g}", mode.value)
                 : mode.value >= 0      ? fmt::format("{:.5g}", mode.frequency())
                                        : "a motion that grows";
    }
    if (numbers.empty()) continue;
    print("{:<18}{} {}\n", kind == Kind::buckling ? "buckling at" : "frequencies", numbers,
          kind == Kind::buckling ? "times the loads" : "Hz");
  }
}

/// The parameters of a point; on a mesh in space its position.
std::string place_text(const solution::Summary& s, const Eigen::Vector2d& at, const Eigen::Vector3d& position) {
  return s.is_in_space ? fmt::format("({:.4g})", fmt::join(position, ", "))
                       : fmt::format("({:g})", fmt::join(at, ", "));
}

/// Prints the largest displacement of the steps where the end of the last one has a smaller one.
void print_largest_of_steps(const computation::Result& result) {
  constexpr double more = 1.01;
  if (result.history.empty()) return;
  const computation::HistoryEntry& most = *std::ranges::max_element(
      result.history, {}, [](const computation::HistoryEntry& entry) { return entry.summary.max_displacement; });
  const solution::Summary& s = most.summary;
  if (!(s.max_displacement > more * result.summary.max_displacement)) return;
  print(
      "at time {:<10.4g}|u| {:.4g} m, or {:.4g} thicknesses, |r| {:.4g} rad, strain {:.2g} %, the most of all times\n",
      most.factors.time, s.max_displacement, s.max_relative_displacement, s.max_rotation, 100 * s.max_strain);
}

}  // namespace

void print_summary(const computation::Result& result) {
  const auto& s = result.summary;
  const auto& c = result.certificate;
  print("\nstatus            {}\n", computation::status_text(result));
  const double total = std::max(s.energy.total(), 1e-300);
  print("energy            {:.9e} J (membrane {:.1f} %, bending {:.1f} %, shear {:.1f} %)\n", s.energy.total(),
        100 * s.energy.membrane / total, 100 * s.energy.bending / total, 100 * s.energy.shear / total);
  print_estimates(result);
  print_linearity(result);
  print_stability(result);
  print_modes(result.modes);
  print("largest           |u| {:.4g} m, or {:.4g} thicknesses, |r| {:.4g} rad\n", s.max_displacement,
        s.max_relative_displacement, s.max_rotation);
  print_stress(result);
  print("                  strain {:.2g} %\n", 100 * s.max_strain);
  print_largest_of_steps(result);
  print_layers(result);
  print("loads             {} N\n", vector_text(s.loads.force));
  print("supports          {} N\n", vector_text(s.support_reaction.force));
  for (const auto& r : s.support_reactions)
    if (s.support_reactions.size() > 1) print("  {:<16}{} N\n", r.boundary, vector_text(r.reaction.force));
  double largest = s.loads.force.norm();
  for (const auto& r : s.support_reactions) largest = std::max(largest, r.reaction.force.norm());
  for (const auto& corner : s.corner_reactions)
    if (corner.reaction.force.norm() > 1e-6 * largest)  // smaller forces are rounding errors
      print("  at {:<12} {} N, corner of {}\n", place_text(s, corner.at, corner.position),
            vector_text(corner.reaction.force), fmt::format("{}", fmt::join(corner.boundaries, ", ")));
  for (const auto& p : s.point_reactions)
    print("  at {:<12} {} N\n", place_text(s, p.at, p.position), vector_text(p.force));
  for (const auto& f : s.foundations)
    print("{:<17} {} N, energy {:.4g} J\n", f.name, vector_text(f.reaction.force), f.energy);
  for (const auto& b : s.body_reactions) {
    print("{:<17} displacement {} m, rotation {} rad\n", b.name, vector_text(b.displacement), vector_text(b.rotation));
    if (b.reaction.force.norm() + b.moment_at_reference.norm() > 0)
      print("  reaction        {} N, {} N m\n", vector_text(b.reaction.force), vector_text(b.moment_at_reference));
  }
  if (result.has_obstacle) {
    for (const auto& o : s.obstacles)
      print("{:<17} {} N\n", s.obstacles.size() == 1 ? "obstacle" : o.name, vector_text(o.reaction.force));
    print(
        "contact           {} nodes, area {:.6e} m^2{}\n", s.touching_nodes, s.contact_area,
        std::isfinite(result.max_pressure()) ? fmt::format(", pressure at most {:.6e} Pa", result.max_pressure()) : "");
    print_zones(s.obstacles);
    if (s.edge.is_line())
      print("on edges          {} nodes, {:.6e} N, line reaction at most {:.6e} N/m\n", s.edge.nodes, s.edge.force,
            s.edge.max_per_length);
    const double between = std::isfinite(c.min_gap_between) ? std::max(0.0, -c.min_gap_between) : 0.0;
    print("penetration       {:.2e} m between nodes, {:.2e} m at nodes\n", between, std::max(0.0, -c.min_gap_nodes));
    print_lifts(result);
  }
  const bool is_finite = result.rotations == element::Rotations::finite;
  print("certificate       equilibrium {:.1e}, force balance {:.1e}, moment balance {:.1e}, energy {} {:.1e}\n",
        c.stationarity, c.force_balance, c.moment_balance, is_finite ? "derivative" : "identity",
        is_finite ? c.energy_derivative : c.energy_identity);
  if (result.has_obstacle)
    print("                  min pressure {:.2e} Pa, max |pressure * gap| {:.1e}\n", c.min_pressure, c.complementarity);
  for (const auto& p : result.probes) {
    print("probe {:<12}u = {} m, r = {}\n", p.name, vector_text(p.values.u), vector_text(p.values.r));
    if (result.has_obstacle)
      print("                  gap = {:.6e} m, pressure = {:.6e} Pa\n", p.values.gap, p.values.pressure);
  }
}

}  // namespace plastron::app
