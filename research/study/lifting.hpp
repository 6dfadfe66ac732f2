// The softest admissible change of the displacement that changes the gap by a given amount at given nodes.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <optional>
#include <span>

namespace plastron::study {

/// |W|_a = a(W, W)^{1/2} of the W in V with n . (w + z s) = change at the owned nodes marked in `at` that has the least
/// energy [J^{1/2}]: the capacity of these nodes. Other nodes and components are free, supports hold at zero. Zero if no
/// node is marked on any rank, empty if the system is singular. (collective)
std::optional<double> lifting_norm(const assembly::DiscreteShell& discrete, std::span<const char> at, double change);

}  // namespace plastron::study
