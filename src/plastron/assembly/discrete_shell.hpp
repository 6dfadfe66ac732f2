// A shell on one mesh, linearised at a state and ready to be solved: strains, nodal coordinates with their bounds, loads.
#pragma once
#include <plastron/assembly/load_vector.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/shell_operator.hpp>
#include <plastron/contact/problem.hpp>

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

  // Of the state:
  State state{};
  RigidObstacles obstacles{};
  NodalCoordinates coordinates{};
  algebra::Vector load{};  ///< load factor times full_load

  const fem::Space& space() const { return shell.space(); }
  /// What multiplies the form of normal_rotation.hpp: 1/p (M13), rho (M14) or nothing.
  double tangency_factor() const;
  /// f = A y through strains, the form of normal_rotation.hpp included; needs y's ghosts (collective).
  void apply(const algebra::Vector& y, algebra::Vector& f) const;
  /// f = A y - l, what supports and obstacles carry, tied and carried nodes not yet handed on; owned values, needs y's ghosts (collective).
  void residual(const algebra::Vector& y, algebra::Vector& f) const;
  /// (M16) at a point that the state has moved, against obstacle k.
  obstacle::Gap gap(std::size_t k, const obstacle::ShellPoint& at) const { return obstacles.gap(k, at); }
  /// Linearised gap between a local node and obstacle k of fields (u, r), without the state's lift: sees r's tangential part [m].
  double nodal_gap(std::size_t k, std::size_t node, const algebra::Vector& y) const;
  /// How far its force has pressed obstacle k on from where its gaps are linearised [m].
  double way_pressed(std::size_t k) const;
  /// How far forces have pressed the obstacles, from where they stood at the start [m].
  std::vector<double> positions() const;
  /// (u, r) of the state at points of a local cell, a row each.
  element::CellField state_values(std::size_t cell, const element::BasisAt& at) const;
  /// Where supports hold points of Omega, each once.
  std::vector<Eigen::Vector2d> support_points() const;
};

/// Linearises the shell at another state: the gaps at the faces where it has moved them, with them coordinates and bounds, and the
/// loads. Strains are linear; with finite rotations their operator would change here too (collective). Throws SupportError,
/// ObstacleError.
void linearise(DiscreteShell& discrete, State state);

/// All that discretises a shell, independent of the mesh.
struct ShellDescription {
  CrossSections sections{};
  bool tying = true;
  element::Tangency tangency{};
  std::vector<Support> supports{};
  std::vector<AreaLoad> area_loads{};
  std::vector<EdgeLoad> edge_loads{};
  Vector3d gravity = Vector3d::Zero();  ///< g [m/s^2]
  RigidObstacles obstacles{};
};

/// Linearised at `state` (collective). Throws SupportError, ObstacleError.
std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state = {});

/// Its stiffness matrix in nodal coordinates, the form of normal_rotation.hpp included (collective).
algebra::Matrix stiffness_matrix(const DiscreteShell& discrete);

/// The box-constrained program of a discrete shell, with b(U, q) = 0 as equations in the mixed formulation. `matrix` is its
/// stiffness_matrix(); both must outlive the result (collective).
contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix);

}  // namespace plastron::assembly
