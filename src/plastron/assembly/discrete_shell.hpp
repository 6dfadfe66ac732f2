// A shell on one mesh, ready to be solved: strains, nodal coordinates with their bounds, loads.
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
  NodalCoordinates coordinates;
  algebra::Vector load;  ///< Cartesian nodal forces and couples (block 6)
  RigidObstacles obstacles;
  element::Tangency tangency;
  std::vector<Eigen::Vector2d> support_points{};  ///< where supports hold points of Omega, each once

  const fem::Space& space() const { return shell.space(); }
  /// What multiplies the form of normal_rotation.hpp: 1/p (M13), rho (M14) or nothing.
  double tangency_factor() const;
  /// f = A y through strains, the form of normal_rotation.hpp included; needs y's ghosts (collective).
  void apply(const algebra::Vector& y, algebra::Vector& f) const;
};

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

/// (collective) Throws SupportError.
std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description);

/// Its stiffness matrix in nodal coordinates, the form of normal_rotation.hpp included (collective).
algebra::Matrix stiffness_matrix(const DiscreteShell& discrete);

/// The box-constrained program of a discrete shell, with b(U, q) = 0 as equations in the mixed formulation. `matrix` is its
/// stiffness_matrix(); both must outlive the result (collective).
contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix);

}  // namespace plastron::assembly
