// What supports carry, boundary by boundary.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/certificate/wrench.hpp>

#include <string>
#include <vector>

namespace plastron::certificate {

/// Force [N] and couple [N m] of the supports at an owned node.
struct NodalSupportForce {
  std::size_t node = 0;
  Eigen::Matrix<double, 6, 1> force = Eigen::Matrix<double, 6, 1>::Zero();
};

struct SupportReaction {
  std::string boundary{};
  Wrench reaction{};       ///< on the shell
  std::int64_t nodes = 0;  ///< that belong to it
};

/// One for every boundary that a support names, in the order of the case. A node of several boundaries belongs to the first of them: a corner's
/// share of two edges cannot be told apart, and falls with the mesh width (collective).
std::vector<SupportReaction> support_reactions(const assembly::DiscreteShell& discrete,
                                               const std::vector<NodalSupportForce>& forces);

}  // namespace plastron::certificate
