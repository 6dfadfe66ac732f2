// Where in the history of loading a state is, and the factors there.
#pragma once
#include <cstddef>
#include <vector>

namespace plastron::assembly {

/// The place in the history of loading, and the factors there of what the case gives.
struct Factors {
  double time = 0;               ///< number of finished steps, including the part of this one
  double loads = 1;              ///< factor of all loads; under control that of the present state
  double supports = 1;           ///< factor of the prescribed components of supports and rigid bodies
  std::vector<double> forces{};  ///< factors of the forces that press obstacles; empty: 1

  double force(std::size_t obstacle) const { return forces.empty() ? 1 : forces[obstacle]; }
};

}  // namespace plastron::assembly
