// The path of the shell from its start to the solution at hand (M36): states between which it moves straight, and no
// obstacle passes through it.
#pragma once
#include <plastron/certificate/crossings.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/problem/instants.hpp>

#include <utility>
#include <vector>

namespace plastron::computation {

/// Whether the path can matter: some obstacle has a far side.
bool has_path_to_prove(const assembly::RigidObstacles& obstacles);

/// Returns a solution as a state of the path.
certificate::Station station_of(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

class Path {
 public:
  Path() { restart(); }

  /// Begins at the undeformed shell.
  void restart() {
    stations_.assign(1, {});
    is_broken = false;
  }
  /// An obstacle may have passed in these cells of this rank: nothing is proved from there on.
  void break_at(std::vector<std::size_t> cells) {
    is_broken = true;
    crossed = std::move(cells);
  }
  bool is_broken = false;
  std::vector<std::size_t> crossed{};
  /// Returns this rank's places where an obstacle may pass between the last state and another one (collective).
  std::vector<certificate::Crossing> crossings_to(const assembly::DiscreteShell& discrete,
                                                  const certificate::Station& next) const;
  /// Adds a state to which no obstacle passes. States that the way to it does not need are forgotten (collective).
  void extend(const assembly::DiscreteShell& discrete, certificate::Station next);
  /// The states, the first one undeformed.
  std::vector<certificate::Station>& stations() { return stations_; }
  const std::vector<certificate::Station>& stations() const { return stations_; }

 private:
  std::vector<certificate::Station> stations_{};
};

/// Returns the crossings of all ranks in words (collective).
Passing passing_of(const assembly::DiscreteShell& discrete, const std::vector<certificate::Crossing>& crossings,
                   double from, double to);

/// Proves a path again, from state to state (collective).
Passing proven_again(const assembly::DiscreteShell& discrete, const std::vector<certificate::Station>& stations);

/// Returns the next part of the way between two instants, after `done`. It is so short that obstacles do not pass through the
/// shell at rest at `y` (collective).
double next_part(const assembly::DiscreteShell& discrete, const algebra::Vector& y, const problem::Instant& from,
                 const problem::Instant& to, double done);

}  // namespace plastron::computation
