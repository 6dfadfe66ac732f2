#include <plastron/estimation/functionals.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace plastron::estimation {

namespace {

std::string unit(const Energy& /*energy*/) { return "J"; }
std::string unit(const LoadWork& /*work*/) { return "J"; }
std::string unit(const ObstacleForce& /*force*/) { return "N"; }
std::string unit(const SupportForce& /*force*/) { return "N"; }
std::string unit(const ContactArea& /*area*/) { return "m^2"; }
std::string unit(const PointDisplacement& point) { return point.component < 3 ? "m" : "rad"; }
std::string unit(const PointStress& point) {
  if (point.kind != StressKind::resultant) return "Pa";
  return point.component < 3 || point.component > 5 ? "N/m" : "N";
}
std::string unit(const LargestStress& /*stress*/) { return "Pa"; }
std::string unit(const ObstaclePosition& /*position*/) { return "m"; }

constexpr std::array axis_names{"x", "y", "z"};

/// Adds goals for a force: its norm, then its components.
template <class Force>
void add_force(const std::string& name, Force force, std::vector<Goal>& goals) {
  goals.push_back({name, force});
  for (int i = 0; i < 3; ++i) {
    force.component = i;
    goals.push_back({name + "." + axis_names[static_cast<std::size_t>(i)], force});
  }
}

void add_probe(const Catalogue::Point& probe, const Catalogue& catalogue, std::vector<Goal>& goals) {
  constexpr std::array resultants{"N.11", "N.22", "N.12", "M.11", "M.22", "M.12", "Q.1", "Q.2"};
  const std::string prefix = "probe." + probe.name + ".";
  for (int i = 0; i < 6; ++i)
    goals.push_back(
        {prefix + (i < 3 ? "u." : "r.") + axis_names[static_cast<std::size_t>(i % 3)], PointDisplacement{probe.at, i}});
  PointStress stress{.at = probe.at, .axis = catalogue.axis, .is_smooth = catalogue.is_smooth};
  const auto add = [&](const std::string& name, StressKind kind, int component) {
    stress.kind = kind;
    stress.component = component;
    goals.push_back({prefix + name, stress});
  };
  for (std::size_t i = 0; i < resultants.size(); ++i) add(resultants[i], StressKind::resultant, static_cast<int>(i));
  constexpr std::array<std::pair<const char*, StressKind>, 3> heights{{{"stress_lower", StressKind::lower},
                                                                       {"stress_middle", StressKind::middle},
                                                                       {"stress_upper", StressKind::upper}}};
  for (const auto& [name, kind] : heights)
    for (int i = 0; i < 3; ++i) add(name + std::string(i == 0 ? ".11" : i == 1 ? ".22" : ".12"), kind, i);
  add("von_mises", StressKind::von_mises, 0);
}

}  // namespace

std::string unit_of(const Functional& functional) {
  return std::visit([](const auto& f) { return unit(f); }, functional);
}

std::vector<Goal> all_goals(const Catalogue& catalogue) {
  std::vector<Goal> goals{
      {"energy", Energy{}}, {"load_work", LoadWork{}}, {"stress", LargestStress{catalogue.is_smooth}}};
  if (!catalogue.obstacles.empty()) {
    add_force("reaction", ObstacleForce{}, goals);
    goals.push_back({"contact_area", ContactArea{}});
  }
  for (std::size_t k = 0; k < catalogue.obstacles.size(); ++k) {
    const std::string prefix = "obstacle." + catalogue.obstacles[k].name + ".";
    add_force(prefix + "force", ObstacleForce{.obstacle = k}, goals);
    goals.push_back({prefix + "area", ContactArea{.obstacle = k}});
    if (catalogue.obstacles[k].is_pressed) goals.push_back({prefix + "position", ObstaclePosition{k}});
  }
  add_force("support_reaction", SupportForce{}, goals);
  for (const std::string& boundary : catalogue.supports)
    add_force("support." + boundary + ".force", SupportForce{.boundary = boundary}, goals);
  for (const Catalogue::Point& probe : catalogue.probes) add_probe(probe, catalogue, goals);
  return goals;
}

std::optional<Goal> find_goal(const std::string& name, const Catalogue& catalogue) {
  std::vector<Goal> goals = all_goals(catalogue);
  const auto found = std::ranges::find(goals, name, &Goal::name);
  if (found == goals.end()) return {};
  return std::move(*found);
}

}  // namespace plastron::estimation
