#include <plastron/computation/contradiction.hpp>

#include <plastron/assembly/box_problem.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/finite/modes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plastron::computation {

namespace {

/// Room that is missing at a node: length, both obstacles (the second -1: a support), place in Omega.
using Missing = std::array<double, 5>;

void keep_larger(Missing& most, const Missing& other) {
  if (other[0] > most[0]) most = other;
}

/// Returns the largest gap that two bounds of one coordinate of an owned node lack.
Missing missing_at(const assembly::DiscreteShell& discrete, std::size_t node) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const Eigen::Vector2d& x = discrete.points[node].x;
  Missing most{};
  for (const assembly::ContactRow& row : coordinates.rows_of(node)) {
    if (coordinates.is_fixed_inside(row, discrete.points[node]))
      keep_larger(most, {-row.bound_gap, static_cast<double>(row.obstacle), -1, x[0], x[1]});
    for (const assembly::ContactRow& other : coordinates.rows_of(node)) {
      if (!row.binds || !other.binds || row.coordinate != other.coordinate || !(row.scale > 0 && other.scale < 0))
        continue;
      const double lower = -row.bound_gap / row.scale, upper = -other.bound_gap / other.scale;
      keep_larger(most, {(lower - upper) * row.scale, static_cast<double>(row.obstacle),
                         static_cast<double>(other.obstacle), x[0], x[1]});
    }
  }
  return most;
}

/// Whether a length is the rounding of gaps (collective).
bool is_rounding(const assembly::DiscreteShell& discrete, double length) {
  constexpr double negligible_part = 1e-9;
  double largest = 0;
  for (const assembly::ContactRow& row : discrete.coordinates.rows)
    largest = std::max(largest, std::abs(row.bound_gap));
  return length < negligible_part * algebra::max_over_ranks(largest, discrete.space().layout->comm);
}

std::string text_of_place(const assembly::DiscreteShell& discrete, const Eigen::Vector2d& x) {
  const fem::Surface& surface = discrete.shell.surface();
  return surface.has_directors() ? fem::place_text(surface, x) : fmt::format("x = {:.4g}, y = {:.4g}", x[0], x[1]);
}

}  // namespace

std::string contradiction_text(const assembly::DiscreteShell& discrete) {
  Missing most{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    keep_larger(most, missing_at(discrete, i));
  const std::vector<double> all =
      algebra::gather_over_ranks(std::vector<double>(most.begin(), most.end()), discrete.space().layout->comm);
  for (std::size_t at = 0; at < all.size(); at += most.size())
    keep_larger(most, {all[at], all[at + 1], all[at + 2], all[at + 3], all[at + 4]});
  if (most[0] == 0) return {};
  const auto name = [&](double k) { return discrete.obstacles_at_start.all[static_cast<std::size_t>(k)].text(); };
  const std::string place = text_of_place(discrete, {most[3], most[4]});
  const std::vector<std::size_t> pressed = assembly::pressed_obstacles(discrete);
  const auto is_pressed = [&](double k) {
    return std::ranges::any_of(pressed, [k](std::size_t other) { return static_cast<double>(other) == k; });
  };
  if (is_pressed(most[1]) && is_pressed(most[2]) && is_rounding(discrete, most[0]))
    return fmt::format("Forces press {} and {} from both sides onto the shell at {}; hold one of them", name(most[1]),
                       name(most[2]), place);
  return most[2] < 0
             ? fmt::format("A support holds the shell {:.2g} m deep inside of {} at {}", most[0], name(most[1]), place)
             : fmt::format("{:.2g} m are missing between {} and {} at {}", most[0], name(most[1]), name(most[2]),
                           place);
}

std::string softest_motion_text(const assembly::DiscreteShell& discrete, const solution::NodalSolution& nodal) {
  const finite::ExaminedStability found = finite::examine_stability(discrete, nodal);
  if (!found.motion.layout()) return {};
  using Moved = std::array<double, 6>;  // length, place in Omega, displacement
  Moved most{};
  const auto keep_farther = [&](const Moved& other) {
    if (other[0] > most[0]) most = other;
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const Eigen::Vector3d v = assembly::node_values(found.motion, i).head<3>();
    const Eigen::Vector2d& x = discrete.points[i].x;
    keep_farther({v.norm(), x[0], x[1], v[0], v[1], v[2]});
  }
  const std::vector<double> all =
      algebra::gather_over_ranks(std::vector<double>(most.begin(), most.end()), discrete.space().layout->comm);
  for (std::size_t at = 0; at < all.size(); at += most.size())
    keep_farther({all[at], all[at + 1], all[at + 2], all[at + 3], all[at + 4], all[at + 5]});
  if (most[0] == 0) return {};
  return fmt::format(
      "The motion of least stiffness moves the shell most at {}, along ({:.2f}, {:.2f}, {:.2f}): it has {:.2g} of the "
      "stiffness without stresses",
      text_of_place(discrete, {most[1], most[2]}), most[3] / most[0], most[4] / most[0], most[5] / most[0],
      found.stability.margin);
}

}  // namespace plastron::computation
