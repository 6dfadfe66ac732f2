// Rigid bodies: their motions, the reactions where these are prescribed, and the residuals of their free unknowns.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/solution/wrench.hpp>

#include <limits>
#include <string>
#include <vector>

namespace plastron::solution {

struct BodyReaction {
  std::string name{};
  Vector3d reference = Vector3d::Zero();     ///< reference point [m]
  Vector3d displacement = Vector3d::Zero();  ///< d [m]
  Vector3d rotation = Vector3d::Zero();      ///< theta [rad]
  /// Reaction of the supports, zero along free components; `reaction.moment` is about the origin as everywhere.
  Wrench reaction{};
  Vector3d moment_at_reference = Vector3d::Zero();  ///< moment of the reaction about the reference point [N m]
  /// The least gap at the body's nodes [m]. No bound constrains it. Infinite without obstacles.
  double least_gap = std::numeric_limits<double>::infinity();
};

/// Balance of all bodies.
struct BodyBalance {
  std::vector<BodyReaction> bodies{};
  // Squares of the free unknowns' residuals and of all forces on the six unknowns, on this rank [N^2]. Moments are
  // divided by the body's length.
  double free_residual = 0, all_forces = 0;
  double support_work = 0;  ///< work of the reactions, all ranks [J]
  /// The largest distance between a node of a supported body and its place in the body's motion, on this rank [m].
  double support_error = 0;
  double force_scale = 0, moment_scale = 0;  ///< sums of the norms of the reactions, all ranks [N, N m]
  Wrench reaction{};                         ///< sum of the reactions about the origin, all ranks
};

/// Computes the balance of all bodies on owned nodes (collective). `residual` is C' (A y - l): forces at
/// constrained nodes have been moved to the free ones.
BodyBalance body_balance(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                         const algebra::Vector& residual);

/// The largest distance of the owned nodes of a body from its motion, without components that hinges leave free, and of the
/// motion from its prescribed components [m]. Counts displacements u and rotations times thickness, e r (collective).
double distance_from_body(const assembly::DiscreteShell& discrete, std::size_t body, const algebra::Vector& y);

}  // namespace plastron::solution
