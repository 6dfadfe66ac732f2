#include <plastron/computation/path.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/certificate/core_depth.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/obstacle/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace plastron::computation {

namespace {

std::vector<certificate::Crossing> agreed_crossings(const assembly::DiscreteShell& discrete,
                                                    const certificate::Station& from, const certificate::Station& to) {
  return algebra::in_agreement<obstacle::ObstacleError>(discrete.space().layout->comm,
                                                        [&] { return certificate::crossings(discrete, from, to); });
}

bool is_free(const assembly::DiscreteShell& discrete, const certificate::Station& from,
             const certificate::Station& to) {
  const auto found = static_cast<std::int64_t>(agreed_crossings(discrete, from, to).size());
  return algebra::sum_over_ranks(found, discrete.space().layout->comm) == 0;
}

}  // namespace

bool has_path_to_prove(const assembly::RigidObstacles& obstacles) {
  return !obstacles.are_linear && std::ranges::any_of(obstacles.all, certificate::has_far_side);
}

certificate::Station station_of(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  certificate::Station station{
      .displacement = y, .time = discrete.state.factors.time, .positions = discrete.positions()};
  station.displacement.update_ghosts();
  return station;
}

std::vector<certificate::Crossing> Path::crossings_to(const assembly::DiscreteShell& discrete,
                                                      const certificate::Station& next) const {
  return agreed_crossings(discrete, stations_.back(), next);
}

void Path::extend(const assembly::DiscreteShell& discrete, certificate::Station next) {
  if (stations_.size() > 1 && is_free(discrete, *(stations_.end() - 2), next)) stations_.pop_back();
  stations_.push_back(std::move(next));
}

Passing passing_of(const assembly::DiscreteShell& discrete, const std::vector<certificate::Crossing>& crossings,
                   double from, double to) {
  const MPI_Comm comm = discrete.space().layout->comm;
  Passing passing{.cells = algebra::sum_over_ranks(static_cast<std::int64_t>(crossings.size()), comm)};
  if (passing.cells == 0) return passing;
  const certificate::Crossing first =
      algebra::gathered(std::span(crossings).first(crossings.empty() ? 0 : 1), comm).front();
  passing.place = fmt::format("{} at {}{}", discrete.obstacles_at_start.all[first.obstacle].text(),
                              fem::place_text(discrete.shell.surface(), first.x),
                              from == to ? "" : fmt::format(", time {:.4g}", from + first.part * (to - from)));
  return passing;
}

Passing proven_again(const assembly::DiscreteShell& discrete, const std::vector<certificate::Station>& stations) {
  Passing passing;
  for (std::size_t i = 1; i < stations.size() && passing.cells == 0; ++i)
    passing = passing_of(discrete, agreed_crossings(discrete, stations[i - 1], stations[i]), stations[i - 1].time,
                         stations[i].time);
  return passing;
}

double next_part(const assembly::DiscreteShell& discrete, const algebra::Vector& y, const problem::Instant& from,
                 const problem::Instant& to, double done) {
  constexpr double least = 0x1p-10;
  if (from.factors.time == to.factors.time || !has_path_to_prove(discrete.obstacles)) return 1;
  certificate::Station now = station_of(discrete, y), then = now;
  now.time = problem::between(from, to, done).factors.time;
  for (double next = 1;; next = done + (next - done) / 2) {
    then.time = problem::between(from, to, next).factors.time;
    if (next - done <= least || is_free(discrete, now, then)) return next;
  }
}

}  // namespace plastron::computation
