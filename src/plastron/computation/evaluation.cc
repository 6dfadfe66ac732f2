#include <plastron/computation/evaluation.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <type_traits>

namespace plastron::computation {

namespace {

/// Whether all nodes of some cell touch an obstacle (collective).
bool has_cell_in_contact(const Solution& solution, std::size_t obstacle) {
  const fem::Space& space = solution.discrete->space();
  const algebra::Vector& touching = solution.nodal.touching;
  const auto obstacles = static_cast<std::size_t>(touching.block());
  std::int64_t cells = 0;
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    if (std::ranges::all_of(space.nodes(c), [&](algebra::LocalIndex node) {
          return touching.local()[static_cast<std::size_t>(node) * obstacles + obstacle] != 0;
        }))
      ++cells;
  return algebra::sum_over_ranks(cells, space.layout->comm) > 0;
}

/// Returns the width of strips and rings, or the radius of round zones [m].
double width_of(const solution::ContactZone& zone) {
  const double length = zone.line_length() + zone.rim_length();
  return length > 0 ? 2 * zone.area / length : 0;
}

/// Returns zones that are wider than the layer at their edges, half of the thickness. Narrower ones carry their
/// reaction like lines.
std::vector<solution::ContactZone> wide_zones(std::vector<solution::ContactZone> zones, double thickness) {
  std::erase_if(zones, [&](const solution::ContactZone& zone) { return width_of(zone) < thickness / 2; });
  return zones;
}

using recovery::PointValues;

/// Returns the values on this rank, if one of its cells contains the point.
std::optional<PointValues> local_values(const Solution& solution, const fem::Location& location) {
  const fem::Space& space = solution.discrete->space();
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    if (const auto xi = fem::local_coordinates(space.shape(), space.cells[c], location))
      return recovery::Recovery(*solution.discrete, solution.nodal, {*xi}, solution.recovery)(c).front();
  return std::nullopt;
}

/// The numbers of a double, or of a vector of doubles.
template <class Value>
auto entries(Value& value) {
  if constexpr (std::is_arithmetic_v<std::remove_const_t<Value>>)
    return std::span(&value, 1);
  else
    return std::span(value.data(), static_cast<std::size_t>(value.size()));
}

void append_numbers(const PointValues& point, std::vector<double>& to) {
  const auto append = [&](const auto& value) { to.insert(to.end(), entries(value).begin(), entries(value).end()); };
  std::apply([&](const auto&... values) { (append(values), ...); }, recovery::numbers_of(point));
}

void set_numbers(std::span<const double> from, PointValues& point) {
  const auto set = [&](auto& value) {
    const auto to = entries(value);
    std::ranges::copy(from.first(to.size()), to.begin());
    from = from.subspan(to.size());
  };
  std::apply([&](auto&... values) { (set(values), ...); }, recovery::numbers_of(point));
}

std::vector<fem::Location> located(const mesh::CoarseMesh& coarse, const std::vector<Eigen::Vector2d>& points,
                                   std::string_view what) {
  std::vector<fem::Location> locations;
  locations.reserve(points.size());
  for (const Eigen::Vector2d& point : points) {
    const auto location = fem::locate(coarse, point);
    if (!location)
      throw mesh::DomainError(fmt::format("{} at ({:g}, {:g}) lies outside of the domain", what, point[0], point[1]));
    locations.push_back(*location);
  }
  return locations;
}

}  // namespace

void judge_certificate(Result& result) {
  result.limits = certificate::certificate_limits({.summary = result.summary, .certificate = result.certificate},
                                                  result.formulation);
  if (result.passing)
    result.limits.push_back(
        {"crossed_cells", "1", static_cast<double>(result.passing->cells), 0, false,
         "no obstacle passes through the shell on its path from the start; where it may have, "
         "refine the mesh there, ask for an accuracy in place of the mesh, or allow it more unknowns",
         result.passing->place});
  result.missed_limits.clear();
  for (const auto& limit : result.limits)
    if (!limit.holds())
      result.missed_limits +=
          fmt::format("{}{} ({})", result.missed_limits.empty() ? "" : "; ", limit.text(), limit.reason);
  if (result.status == contact::Status::solved && !result.missed_limits.empty())
    result.status = contact::Status::inaccurate;
}

bool is_at_rest(const solution::Summary& summary) {
  return summary.max_displacement == 0 && summary.initial_energy == 0 && summary.load_norms == 0;
}

void examine_stability(Result& result, Solution& solution) {
  result.stability.reset();
  const bool is_solved = result.status == contact::Status::solved || result.status == contact::Status::inaccurate;
  if (!solution.discrete->depends_on_path() || !is_solved) return;
  if (is_at_rest(result.summary)) {  // also where nothing holds it
    result.stability = {.margin = 1, .margin_without_weak_contact = 1};
    return;
  }
  finite::ExaminedStability found = finite::examine_stability(*solution.discrete, solution.nodal);
  result.stability = found.stability;
  const double margin = found.stability.margin;
  if (found.motion.layout())
    solution.modes.push_back({.kind = Mode::Kind::softest, .value = margin, .shape = std::move(found.motion)});
  if (!(margin > 0)) result.status = contact::Status::unstable;
}

void add_contact_zones(Result& result) {
  auto zones = zones::contact_zones(*result.solution->discrete, result.solution->nodal);
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (solution::ContactZone& zone : zones[k]) zone.reaction.move_point(result.summary.moment_point);
    result.summary.obstacles[k].zones = std::move(zones[k]);
  }
}

double edge_change(const Solution& one, const Solution& other, double least_thickness) {
  const auto zones = zones::contact_zones(*one.discrete, one.nodal);
  const auto others = zones::contact_zones(*other.discrete, other.nodal);
  double most = 0;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    if (!has_cell_in_contact(one, k)) continue;
    const auto wide = wide_zones(zones[k], least_thickness);
    if (!wide.empty()) most = std::max(most, solution::relative_distance(wide, others[k]));
  }
  return most;
}

void choose_recovery(const problem::Output& output, Solution& solution) {
  solution.recovery.axis = output.axis;
  solution.recovery.patches.reset();
  if (output.smooth)
    solution.recovery.patches = std::make_shared<recovery::ResultantPatches>(*solution.discrete, solution.nodal);
}

void find_stress_peak(Result& result) {
  const Solution& solution = *result.solution;
  result.singular_places = recovery::singular_places(*solution.discrete, solution.nodal, result.summary);
  result.layers =
      recovery::layer_stresses(*solution.discrete, solution.nodal, solution.recovery, result.singular_places);
  result.peak = recovery::stress_peak(*solution.discrete, solution.nodal, solution.recovery, result.singular_places);
  if (!result.estimates) return;
  for (const estimation::GoalEstimate& goal : result.estimates->goals)
    if (goal.name == "stress") result.peak.error = goal.error();
}

std::vector<PointValues> values_at(const Solution& solution, const std::vector<Eigen::Vector2d>& points,
                                   std::string_view what) {
  const fem::Space& space = solution.discrete->space();
  const MPI_Comm comm = space.layout->comm;
  const auto locations = located(*space.coarse, points, what);
  const auto found = algebra::in_agreement(comm, [&] {
    std::vector<std::optional<PointValues>> mine;
    mine.reserve(locations.size());
    for (const fem::Location& location : locations) mine.push_back(local_values(solution, location));
    return mine;
  });
  std::vector<std::size_t> own_points;
  std::vector<double> own_numbers;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) {
      own_points.push_back(i);
      append_numbers(*found[i], own_numbers);
    }
  const auto found_points = algebra::gathered(own_points, comm);
  const auto numbers = algebra::gathered(own_numbers, comm);
  const std::size_t size = found_points.empty() ? 0 : numbers.size() / found_points.size();
  std::vector<PointValues> values(points.size());
  // Several ranks contain a point between their cells. The lowest one comes last, and its values remain.
  for (std::size_t k = found_points.size(); k-- > 0;)
    set_numbers(std::span(numbers).subspan(k * size, size), values[found_points[k]]);
  for (std::size_t i = 0; i < values.size(); ++i)
    recovery::set_law(solution.discrete->shell.sections().at(*space.coarse, {.coarse = locations[i].coarse}),
                      values[i]);
  return values;
}

std::vector<ProbeValue> probe(const Solution& solution, const std::vector<problem::Probe>& probes) {
  std::vector<ProbeValue> values;
  values.reserve(probes.size());
  for (const problem::Probe& p : probes)
    values.push_back({p.name, values_at(solution, {p.at}, fmt::format("the probe \"{}\"", p.name)).front()});
  return values;
}

}  // namespace plastron::computation
