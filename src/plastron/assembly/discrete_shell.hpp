// A shell on one mesh, linearised at a state and ready to be solved: strains, nodal coordinates with their bounds,
// loads.
#pragma once
#include <plastron/assembly/description.hpp>
#include <plastron/assembly/load_vector.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/shell_operator.hpp>

#include <memory>
#include <vector>

namespace plastron::assembly {

struct DiscreteShell {
  ShellOperator shell;
  std::vector<NodalPoint> points;
  algebra::Vector full_load;  ///< Cartesian nodal forces and couples at load factor 1 (block 6)
  RigidObstacles obstacles_at_start;
  element::Tangency tangency;
  std::vector<Support> supports{};

  // Data of the state:
  State state{};
  RigidObstacles obstacles{};
  NodalCoordinates coordinates{};
  algebra::Vector load{};  ///< load factor times full_load

  const fem::Space& space() const { return shell.space(); }
  /// Factor of the form of normal_rotation.hpp: 1/p (M13), rho (M14) or zero.
  double tangency_factor() const;
  /// Computes f = A y through strains, including the form of normal_rotation.hpp. Needs y's ghosts (collective).
  void apply(const algebra::Vector& y, algebra::Vector& f) const;
  /// Computes f = A y - l, the forces of supports and obstacles, on owned nodes. Forces at constrained nodes have
  /// not yet been moved to other nodes. Needs y's ghosts (collective).
  void residual(const algebra::Vector& y, algebra::Vector& f) const;
  /// Returns the gap (M16) against obstacle k at a point that the state has moved.
  obstacle::Gap gap(std::size_t k, const obstacle::ShellPoint& at) const { return obstacles.gap(k, at); }
  /// Returns the linearised gap of fields (u, r) between a local node and obstacle k, without the state's lift. It uses
  /// the tangential part of r [m].
  double nodal_gap(std::size_t k, std::size_t node, const algebra::Vector& y) const;
  /// Distance by which its force has moved obstacle k since its gaps were linearised [m].
  double way_pressed(std::size_t k) const;
  /// Distances by which forces have moved the obstacles from their positions at the start [m].
  std::vector<double> positions() const;
  /// Returns (u, r) of the state at points of a local cell, one row for each point.
  element::CellField state_values(std::size_t cell, const element::BasisAt& at) const;
  /// Points of Omega that supports fix, each once.
  std::vector<Eigen::Vector2d> support_points() const;
};

/// Linearises the shell at another state: gaps at the faces that the state has moved, their coordinates and bounds, and
/// the loads. Strains are linear; with finite rotations their operator would change here too (collective). Throws
/// SupportError, ObstacleError.
void linearise(DiscreteShell& discrete, State state);

/// Returns the shell linearised at `state` (collective). Throws SupportError, ObstacleError.
std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state = {});

}  // namespace plastron::assembly
