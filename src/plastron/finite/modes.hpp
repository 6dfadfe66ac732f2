// Buckling loads and natural frequencies about a solution of the linear model, with the nodes in contact held on their
// obstacles: small motions v with n . (v + z s) = 0 there. K_0 is the linear stiffness, K_G the geometric stiffness of the
// solution's stresses and contact forces (tangent.hpp), M the mass.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::finite {

struct Modes {
  bool has_solution = false;  ///< false if the stiffness is not definite, or if the iteration did not converge
  std::vector<double> values{};
  std::vector<algebra::Vector> shapes{};  ///< (u, r), block 6, with current ghosts; the largest |u| is 1
};

/// Returns the smallest positive factors of all loads and prescribed displacements at which the shell buckles,
/// (K_0 + factor K_G) v = 0, ascending: at most `count`. Without a solution if a motion is free (collective).
Modes buckling_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count);

/// Returns the smallest squares of angular frequencies [1/s^2], (K_0 + K_G) v = omega^2 M v, ascending. Free motions have
/// 0; negative ones grow: the solution is not stable. Precondition: some density (collective).
Modes vibration_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count);

}  // namespace plastron::finite
