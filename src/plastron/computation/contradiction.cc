// Why there is no solution, in words: bounds leave the shell no room, or a motion has no stiffness.
#include <plastron/algebra/gathered.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/warnings.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/finite/modes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace plastron::computation {

namespace {

/// Room that is missing at a node between an obstacle and another one, or a support.
struct Missing {
  static constexpr std::size_t support = std::numeric_limits<std::size_t>::max();
  double length = 0;
  std::size_t one = support, other = support;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
};

/// The motion of a node.
struct Moved {
  double length = 0;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

template <class Place>
void keep_larger(Place& most, const Place& other) {
  if (other.length > most.length) most = other;
}

/// Returns the place with the largest length on all ranks (collective).
template <class Place>
Place largest_of_all(Place most, MPI_Comm comm) {
  for (const Place& other : algebra::gathered(std::array{most}, comm)) keep_larger(most, other);
  return most;
}

/// Returns the largest gap that two bounds of one coordinate of an owned node lack.
Missing missing_at(const assembly::DiscreteShell& discrete, std::size_t node) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  const Eigen::Vector2d& x = discrete.points[node].x;
  Missing most{};
  for (const assembly::ContactRow& row : coordinates.rows_of(node)) {
    if (coordinates.is_fixed_inside(row, discrete.points[node]))
      keep_larger(most, {-row.bound_gap, static_cast<std::size_t>(row.obstacle), Missing::support, x});
    for (const assembly::ContactRow& other : coordinates.rows_of(node)) {
      if (!row.binds || !other.binds || row.coordinate != other.coordinate || !(row.scale > 0 && other.scale < 0))
        continue;
      const double lower = -row.bound_gap / row.scale, upper = -other.bound_gap / other.scale;
      keep_larger(most, {(lower - upper) * row.scale, static_cast<std::size_t>(row.obstacle),
                         static_cast<std::size_t>(other.obstacle), x});
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

}  // namespace

std::string contradiction_text(const assembly::DiscreteShell& discrete) {
  Missing most{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    keep_larger(most, missing_at(discrete, i));
  most = largest_of_all(most, discrete.space().layout->comm);
  if (most.length == 0) return {};
  const auto name = [&](std::size_t k) { return discrete.obstacles_at_start.all[k].text(); };
  const std::string place = fem::place_text(discrete.shell.surface(), most.x);
  const std::vector<std::size_t> pressed = assembly::pressed_obstacles(discrete);
  const auto is_pressed = [&](std::size_t k) { return std::ranges::find(pressed, k) != pressed.end(); };
  if (is_pressed(most.one) && is_pressed(most.other) && is_rounding(discrete, most.length))
    return fmt::format("Forces press {} and {} from both sides onto the shell at {}; hold one of them", name(most.one),
                       name(most.other), place);
  return most.other == Missing::support ? fmt::format("A support holds the shell {:.2g} m deep inside of {} at {}",
                                                      most.length, name(most.one), place)
                                        : fmt::format("{:.2g} m are missing between {} and {} at {}", most.length,
                                                      name(most.one), name(most.other), place);
}

std::string softest_motion_text(const assembly::DiscreteShell& discrete, const solution::NodalSolution& nodal) {
  const finite::ExaminedStability found = finite::examine_stability(discrete, nodal);
  if (!found.motion.layout()) return {};
  Moved most{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
    const Eigen::Vector3d v = assembly::node_values(found.motion, i).head<3>();
    keep_larger(most, {v.norm(), discrete.points[i].x, v});
  }
  most = largest_of_all(most, discrete.space().layout->comm);
  if (most.length == 0) return {};
  const Eigen::Vector3d along = most.displacement / most.length;
  return fmt::format(
      "The motion of least stiffness moves the shell most at {}, along ({:.2f}, {:.2f}, {:.2f}): it has {:.2g} of the "
      "stiffness without stresses",
      fem::place_text(discrete.shell.surface(), most.x), along[0], along[1], along[2], found.stability.margin);
}

}  // namespace plastron::computation
