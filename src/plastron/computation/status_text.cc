// Text on the end of a result, and its pressure. It is separate from the judging code, because tables of results use it
// without the solver's libraries.
#include <plastron/computation/result.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace plastron::computation {

double Mode::frequency() const { return std::sqrt(value) / (2 * std::numbers::pi); }

std::string Mode::name() const {
  if (kind == Kind::softest) return "softest_motion";
  return fmt::format("{}_{}", kind == Kind::buckling ? "buckling" : "vibration", number);
}

std::string word_of(const ModelCheck& check) {
  using contact::Status;
  switch (check.status) {
    case Status::solved:
      return check.is_stable ? "solved" : "unstable";
    case Status::singular:
    case Status::not_held:
    case Status::not_carried:
    case Status::infeasible:
      return "no_solution";
    default:
      return "unknown";
  }
}

std::string status_text(const Result& result) {
  std::string text(contact::explain(result.status));
  if (result.status == contact::Status::inaccurate) text += fmt::format(" Beyond its limit: {}.", result.missed_limits);
  const bool has_words = result.status == contact::Status::infeasible ||
                         result.status == contact::Status::no_equilibrium ||
                         result.status == contact::Status::gap_not_met;
  const bool names_place = has_words && !result.missed_limits.empty();
  if (names_place || result.status == contact::Status::accuracy_not_reached)
    text += fmt::format(" {}.", result.missed_limits);
  return text;
}

double Result::max_pressure() const {
  if (summary.edge.is_line()) return summary.edge.pressure_inside;
  double most = std::numeric_limits<double>::quiet_NaN();
  bool has_zones = false;
  for (const solution::ObstacleContact& obstacle : summary.obstacles)
    for (const solution::ContactZone& zone : obstacle.zones) {
      has_zones = true;
      if (!zone.is_line()) most = std::fmax(most, zone.peak_pressure);
    }
  return has_zones ? most : summary.max_pressure;
}

}  // namespace plastron::computation
