// Where in the history of loading a state is, and the factors there (M35).
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

namespace plastron::energy {

/// The place in the history of loading, and the factors there of what the case gives.
struct Factors {
  double time = 0;               ///< number of finished steps, including the part of this one
  double loads = 1;              ///< factor of loads without their own; under control that of the present state
  double supports = 1;           ///< factor of the prescribed components of supports and rigid bodies without their own
  std::vector<double> forces{};  ///< factors of the forces that press obstacles; empty: 1
  std::vector<double> named{};   ///< own factors, in the order of Problem::factor_names; empty or NaN: those above
  std::vector<char> released{};  ///< 1 for the names of supports that hold nothing; may be shorter than `named`

  double force(std::size_t obstacle) const { return forces.empty() ? 1 : forces[obstacle]; }
  /// Returns the factor of a load; `name`: its place in `named`, -1 if it has none.
  double load(int name) const { return own(name, loads); }
  /// Returns the factor of prescribed components.
  double support(int name) const { return own(name, supports); }
  bool is_released(int name) const {
    return name >= 0 && static_cast<std::size_t>(name) < released.size() &&
           released[static_cast<std::size_t>(name)] != 0;
  }
  /// Returns the factor that a displacement controls: the one with this name, or for -1 that of all loads without their own.
  double& controlled(int name) { return name < 0 ? loads : named.at(static_cast<std::size_t>(name)); }
  /// Returns the derivatives of the factors of loads by the controlled one.
  Factors load_rates(int name) const {
    Factors rates{.loads = 0, .named = named};
    for (double& own : rates.named)
      if (!std::isnan(own)) own = 0;
    rates.controlled(name) = 1;
    return rates;
  }

  /// Returns the factor at a place of `named`.
  double own(int name, double otherwise) const {
    const auto k = static_cast<std::size_t>(name);
    return name < 0 || k >= named.size() || std::isnan(named[k]) ? otherwise : named[k];
  }
};

}  // namespace plastron::energy
