#include <plastron/computation/contradiction.hpp>

#include <plastron/fem/surface.hpp>

#include <fmt/format.h>

#include <array>
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
  const fem::Surface& surface = discrete.shell.surface();
  const std::string place = surface.has_directors() ? fem::place_text(surface, {most[3], most[4]})
                                                    : fmt::format("x = {:.4g}, y = {:.4g}", most[3], most[4]);
  return most[2] < 0
             ? fmt::format("A support holds the shell {:.2g} m deep inside of {} at {}", most[0], name(most[1]), place)
             : fmt::format("{:.2g} m are missing between {} and {} at {}", most[0], name(most[1]), name(most[2]),
                           place);
}

}  // namespace plastron::computation
