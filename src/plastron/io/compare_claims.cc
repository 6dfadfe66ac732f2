#include <plastron/io/claims.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace plastron::io {

namespace {

/// Parts of results.json that follow from the solution. The others describe how and by which program it was found.
constexpr std::array recomputed_parts{
    "formulation",  "rotations", "stability",        "energy", "energy_parts", "load_work",       "loads",
    "moment_point", "reaction",  "support_reaction", "size",   "tangency",     "point_supports",  "contact",
    "obstacles",    "probes",    "certificate",      "stress", "supports",     "corner_supports", "singular_places",
    "rigid_bodies", "linearity", "foundations",      "springs"};
/// Entries of these parts that describe how the solution was found, or need a factor of the matrix.
constexpr std::array not_recomputed{"stress/error",
                                    "contact/admissible/rounds",
                                    "contact/admissible/energy_before",
                                    "contact/admissible/energy_change",
                                    "linearity/status",
                                    "linearity/steps",
                                    "linearity/time",
                                    "linearity/difference",
                                    "linearity/factorisations",
                                    "linearity/seconds",
                                    "linearity/quantities",
                                    "linearity/buckling"};
/// Parts of the last of its levels that follow from the solution.
constexpr std::array recomputed_of_level{
    "cells",    "nodes",        "unknowns", "active",       "gap_error",           "energy",
    "reaction", "contact_area", "min_gap",  "max_rotation", "max_normal_rotation", "multiplier_norm"};

/// Parts of the last level where there are steps: its solution belongs to the first instant.
constexpr std::array recomputed_of_mesh{"cells", "nodes", "unknowns"};
/// Entries of a history record that describe how its solution was found.
constexpr std::array not_recomputed_of_instant{"status", "iterations", "factorisations", "has_jumped", "estimates"};
/// Eigenvalues are found to three digits.
constexpr double tolerance_of_margins = 3e-3;

/// Directions have no error bound: where both principal values are nearly equal, rounding rotates them.
bool is_direction(const std::string& pattern) { return pattern.ends_with("_direction"); }

/// Goes through the recomputed values and compares the claims in the same place.
class Walk {
 public:
  Walk(const Json& units, const Tolerances& tolerances, std::vector<Comparison>& found)
      : units_(units), tolerances_(tolerances), found_(found) {}

  /// `pattern` is the path in the form of `units`.
  void compare(const std::string& path, const std::string& pattern, const Json& recomputed, const Json& claimed) {
    if (is_direction(pattern)) return;
    if (std::ranges::find(not_recomputed, pattern) != not_recomputed.end()) return;
    if (recomputed.is_object())
      compare_object(path, pattern, recomputed, claimed);
    else if (recomputed.is_array())
      compare_array(path, pattern, recomputed, claimed);
    else
      compare_value(path, pattern, recomputed, claimed, magnitude(recomputed));
  }

 private:
  static double magnitude(const Json& value) { return value.is_number() ? std::abs(value.get<double>()) : 0; }

  void compare_object(const std::string& path, const std::string& pattern, const Json& recomputed,
                      const Json& claimed) {
    const bool are_probes = pattern.ends_with("probes");
    for (const auto& [name, value] : recomputed.items())
      compare(fmt::format("{}.{}", path, name), fmt::format("{}/{}", pattern, are_probes ? "*" : name), value,
              claimed.is_object() && claimed.contains(name) ? claimed[name] : Json());
  }

  void compare_array(const std::string& path, const std::string& pattern, const Json& recomputed, const Json& claimed) {
    const bool are_records = std::ranges::any_of(recomputed, [](const Json& j) { return j.is_object(); });
    if (!claimed.is_array() || claimed.size() != recomputed.size()) {
      found_.push_back({path, recomputed, claimed, 0, false});
      return;
    }
    double most = 0;
    for (const Json& value : recomputed) most = std::max(most, magnitude(value));
    for (std::size_t i = 0; i < recomputed.size(); ++i) {
      const std::string item = fmt::format("{}[{}]", path, i);
      if (are_records)
        compare(item, pattern + "/*", recomputed[i], claimed[i]);
      else
        compare_value(item, pattern, recomputed[i], claimed[i], most);
    }
  }

  void compare_value(const std::string& path, const std::string& pattern, const Json& recomputed, const Json& claimed,
                     double most) {
    Comparison c{path, recomputed, claimed, 0, recomputed == claimed};
    if (recomputed.is_number_float() && claimed.is_number()) {
      c.tolerance = pattern.find("margin") != std::string::npos
                        ? tolerance_of_margins
                        : tolerances_.of(units_.value(pattern, std::string("1")), most);
      c.agrees = std::abs(recomputed.get<double>() - claimed.get<double>()) <= c.tolerance;
    }
    found_.push_back(std::move(c));
  }

  const Json& units_;
  const Tolerances& tolerances_;
  std::vector<Comparison>& found_;
};

/// Compares limits, which have no unit of their own in `units`, by their own size.
void compare_limits(const Json& recomputed, const Json& claimed, double rounding, std::vector<Comparison>& found) {
  for (const auto& [row, limit] : recomputed.items())
    for (const char* key : {"at_least", "at_most", "holds"}) {
      if (!limit.contains(key)) continue;
      const Json::json_pointer place = Json::json_pointer("/" + row + "/" + key);
      Comparison c{fmt::format("certificate_limits.{}.{}", row, key), limit[key],
                   claimed.contains(place) ? claimed[place] : Json(), 0, false};
      c.agrees = c.recomputed == c.claimed;
      if (c.recomputed.is_number_float() && c.claimed.is_number()) {
        c.tolerance = rounding * std::abs(c.recomputed.get<double>());
        c.agrees = std::abs(c.recomputed.get<double>() - c.claimed.get<double>()) <= c.tolerance;
      }
      found.push_back(std::move(c));
    }
}

/// Compares settings. An entry on one side only comes from another version's schema, not from another case.
void compare_settings(const std::string& path, const Json& claimed, const Json& of_case,
                      std::vector<Comparison>& found) {
  if (claimed.is_object() && of_case.is_object()) {
    for (const auto& [name, value] : of_case.items())
      if (claimed.contains(name)) compare_settings(fmt::format("{}.{}", path, name), claimed[name], value, found);
  } else if (claimed.is_array() && of_case.is_array() && claimed.size() == of_case.size()) {
    for (std::size_t i = 0; i < of_case.size(); ++i)
      compare_settings(fmt::format("{}[{}]", path, i), claimed[i], of_case[i], found);
  } else if (claimed != of_case) {
    found.push_back({path, of_case, claimed, 0, false});
  }
}

}  // namespace

Tolerances::Tolerances(const computation::Result& recomputed) {
  const solution::Summary& s = recomputed.summary;
  rounding = std::max(1e-9, 10 * recomputed.certificate.stationarity);
  length_ = std::max(s.least_thickness, s.max_displacement);
  size_ = s.size;
  energy_ = std::max({s.energy.total(), std::abs(s.load_work), s.least_energy()});
  pressure_ = std::max(s.max_pressure, s.force_scale() / (s.size * s.least_thickness));
  force_ = std::max({s.force_scale(), s.loads.force.norm(), s.reaction.force.norm(), s.support_reaction.force.norm(),
                     s.max_displacement > 0 ? 2 * s.energy.total() / s.max_displacement : 0});
}

double Tolerances::of(const std::string& unit, double magnitude) const {
  const std::array<std::pair<const char*, double>, 9> least{{{"m", length_},
                                                             {"N", force_},
                                                             {"N m", force_ * size_},
                                                             {"N/m", size_ > 0 ? force_ / size_ : 0},
                                                             {"J", energy_},
                                                             {"Pa", pressure_},
                                                             {"Pa m", pressure_ * length_},
                                                             {"1", 1.0},
                                                             {"rad", size_ > 0 ? length_ / size_ : 0}}};
  const auto found = std::ranges::find(least, unit, [](const auto& entry) { return std::string(entry.first); });
  return rounding * std::max(magnitude, found == least.end() ? 0 : found->second);
}

std::string shown(const Json& value) {
  return value.is_number_float() ? fmt::format("{:.9g}", value.get<double>()) : value.is_null() ? "-" : value.dump();
}

std::vector<Comparison> compare_numbers(const Json& claimed, const computation::Result& recomputed) {
  const Json ours = results_json(recomputed, {});
  const Tolerances tolerances(recomputed);
  std::vector<Comparison> found;
  Walk walk(ours["units"], tolerances, found);
  const auto of = [](const Json& json, const char* name) {
    return json.is_object() && json.contains(name) ? json[name] : Json();
  };
  for (const char* part : recomputed_parts) walk.compare(part, part, ours[part], of(claimed, part));
  compare_limits(ours["certificate_limits"], of(claimed, "certificate_limits"), tolerances.rounding, found);
  const auto last = [&of](const Json& json, const char* name) {
    const Json list = of(json, name);
    return list.is_array() && !list.empty() ? list.back() : Json();
  };
  const Json our_level = last(ours, "levels"), their_level = last(claimed, "levels");
  const bool has_steps = !recomputed.history.empty();
  for (const char* part : has_steps ? std::span<const char* const>(recomputed_of_mesh) : recomputed_of_level)
    walk.compare(fmt::format("levels[last].{}", part), fmt::format("levels/*/{}", part), of(our_level, part),
                 of(their_level, part));
  if (has_steps) {
    Json instant = last(ours, "history");
    for (const char* part : not_recomputed_of_instant) instant.erase(part);
    walk.compare("history[last]", "history/*", instant, last(claimed, "history"));
  }
  return found;
}

std::vector<Comparison> differing_settings(const Json& claimed, const Json& of_case) {
  std::vector<Comparison> found;
  compare_settings("settings", claimed, of_case, found);
  return found;
}

}  // namespace plastron::io
