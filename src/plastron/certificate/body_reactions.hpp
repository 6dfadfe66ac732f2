// What rigid bodies do: their motions, what holds them where they are prescribed, and what of equilibrium their free unknowns miss.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/certificate/wrench.hpp>
#include <plastron/fem/carried_nodes.hpp>

#include <limits>
#include <string>
#include <vector>

namespace plastron::certificate {

struct BodyReaction {
  std::string name{};
  Vector3d reference = Vector3d::Zero();     ///< [m]
  Vector3d displacement = Vector3d::Zero();  ///< d [m]
  Vector3d rotation = Vector3d::Zero();      ///< theta [rad]
  /// What holds the body, zero along what is free; `reaction.moment` about the origin as everywhere.
  Wrench reaction{};
  Vector3d moment_at_reference = Vector3d::Zero();  ///< of the reaction [N m]
  /// The smallest gap at its nodes, which no bound holds; infinite without obstacles [m].
  double least_gap = std::numeric_limits<double>::infinity();
};

/// Of all bodies.
struct BodyBalance {
  std::vector<BodyReaction> bodies{};
  // Squares of the free unknowns' residuals and of all that works on the six of them, moments over the body's length, on this rank [N^2]:
  double free_residual = 0, all_forces = 0;
  double support_work = 0;  ///< of the reactions, all ranks [J]
  /// How far a node of a body that is held is from where the body takes it, on this rank [m].
  double support_error = 0;
  double force_scale = 0, moment_scale = 0;  ///< norms of the reactions, all ranks [N, N m]
  Wrench reaction{};                         ///< all of them about the origin, all ranks
};

/// `residual`: A y - l, tied and carried nodes handed on; on owned nodes (collective).
BodyBalance body_balance(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                         const algebra::Vector& residual);

/// |y - W q| over owned nodes of a body that moves as q, what hinges leave free apart: u and e r [m].
double distance_from_body(const assembly::DiscreteShell& discrete, const fem::PlacedBody& placed,
                          const fem::BodyMotion& motion, const algebra::Vector& y);

}  // namespace plastron::certificate
