// A shell on one mesh, linearised at a state and ready to be solved: strains, nodal coordinates with their bounds,
// loads.
//
// With small rotations only the gaps depend on the state, and coordinates are those of (u, r). With finite rotations (M23-M29)
// coordinates are those of increments from the state, on the deformed shell: at a solution they are 0.
#pragma once
#include <plastron/assembly/description.hpp>
#include <plastron/assembly/load_vector.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/assembly/shell_operator.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

namespace plastron::assembly {

/// Kind of a field (u, r). A solution has the strains of the model. A motion, such as a dual solution, has their derivative at
/// the state. With small rotations both are the same.
enum class FieldKind { solution, motion };

struct DiscreteShell {
  ShellOperator shell;
  std::vector<NodalPoint> points;
  algebra::Vector full_load;  ///< Cartesian nodal forces and couples at load factor 1 (block 6)
  RigidObstacles obstacles_at_start;
  element::Tangency tangency;
  std::vector<Support> supports{};
  element::Rotations rotations = element::Rotations::small;
  std::vector<Eigen::VectorXd> follower_pressure{};  ///< see follower_pressure.hpp

  // Data of the state:
  State state{};
  RigidObstacles obstacles{};
  NodalCoordinates coordinates{};
  algebra::Vector unit_load{};           ///< full_load (with finite rotations: see linearise())
  algebra::Vector load{};                ///< load factor times unit_load
  std::vector<NodalPoint> moved{};       ///< moved_points() of the state; empty with small rotations
  std::vector<fem::BodyPlace> places{};  ///< places of the rigid bodies in the state; empty with small rotations

  const fem::Space& space() const { return shell.space(); }
  /// Block of vectors with a value for each obstacle, at least 1.
  int obstacle_block() const { return std::max(1, static_cast<int>(obstacles_at_start.all.size())); }
  bool has_finite_rotations() const { return rotations == element::Rotations::finite; }
  /// Returns the node where forces act and directions are taken: of the deformed shell if rotations are finite.
  const NodalPoint& place(std::size_t node) const { return has_finite_rotations() ? moved[node] : points[node]; }
  /// Returns the part of (u, r) at a node that the coordinates describe.
  Vector6 in_coordinates(const algebra::Vector& y, std::size_t node) const {
    return has_finite_rotations() ? Vector6(node_values(y, node) - state.at(node)) : node_values(y, node);
  }
  /// Returns (u, r) of a cell's nodes at which strains(field) are linearised; nothing with small rotations.
  std::optional<element::CellField> linearised_at(FieldKind kind, std::size_t cell,
                                                  const element::CellField& field) const;
  /// Returns the vectors by which the strains of motions depend on a cell: of the state, or of the undeformed shell if rotations
  /// are small.
  CellGeometry geometry(std::size_t cell) const;
  /// Returns the strains at the quadrature points of a cell with nodal values y.
  CellStrain strains(std::size_t cell, const algebra::Vector& y) const;
  /// Returns N, M, Q of strains at the quadrature points, times area, less those of initial strains.
  CellStrain stresses(std::size_t cell, const CellStrain& strains) const;
  /// Returns the three parts of the energy (collective) [J].
  Energies energies(const algebra::Vector& y) const;
  /// Returns the three parts of 1/2 a(y, y) for a motion y, a with the stiffness of the material at the state (collective)
  /// [J].
  Energies motion_energies(const algebra::Vector& y) const;
  /// Returns a point of the shell after a motion (u, r). With small rotations r . a_3 moves no face.
  obstacle::ShellPoint shell_point(const Vector3d& phi, const Vector3d& a3, double thickness,
                                   const Vector6& motion) const;
  /// Factor of the form of normal_rotation.hpp: 1/p (M13), rho (M14) or zero.
  double tangency_factor() const;
  /// Computes f = A y through strains, including the form of normal_rotation.hpp. Needs y's ghosts (collective).
  /// Precondition: small rotations.
  void apply(const algebra::Vector& y, algebra::Vector& f) const;
  /// Computes the forces of supports and obstacles on owned nodes, A y - l or the derivative of (M27). Forces at
  /// constrained nodes have not yet been moved to other nodes. Needs y's ghosts (collective).
  void residual(const algebra::Vector& y, algebra::Vector& f) const;
  /// Returns the gap (M16) against obstacle k at a point that the state has moved.
  obstacle::Gap gap(std::size_t k, const obstacle::ShellPoint& at) const { return obstacles.gap(k, at); }
  /// Returns the place on the undeformed face of a local node that obstacle k touches [m].
  Vector3d touching_place(std::size_t k, std::size_t node) const;
  /// Returns the linearised gap of fields (u, r) between a local node and obstacle k, without the state's lift. With
  /// small rotations it uses the tangential part of r [m].
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
/// the loads. With finite rotations directors keep their lengths, the loads of rigid bodies turn with them, and initial stresses are
/// no loads; the state has a displacement afterwards, zero if it had none (collective). Throws SupportError, ObstacleError.
void linearise(DiscreteShell& discrete, State state);

/// Returns the forces of stresses, B' S, on owned nodes. Forces at constrained nodes have not yet been moved to others.
/// `stresses_of(cell)`: stresses at the cell's quadrature points, times area; `geometry_of(cell)`: that of B (collective).
template <class StressesOf, class GeometryOf>
algebra::Vector forces_of_stresses(const ShellOperator& shell, const StressesOf& stresses_of,
                                   const GeometryOf& geometry_of) {
  algebra::Vector f(shell.space().layout, 6);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c)
    shell.scatter(c, shell.forces(c, stresses_of(c), geometry_of(c)), f);
  f.accumulate_ghosts();
  return f;
}

/// Returns the derivative of the energy (M27) at (u, r) = y, without the share of initial strains, like forces_of_stresses()
/// (collective).
algebra::Vector forces_of_energy(const DiscreteShell& discrete, const algebra::Vector& y);

/// Returns the loads at owned nodes with the forces of initial stresses, which are no loads of a shell with finite rotations. They are
/// what the forces of a shell that nothing else loads are compared with (collective).
algebra::Vector loads_and_initial_forces(const DiscreteShell& discrete);

/// Returns the derivative of loads less internal forces by the load factor on owned nodes, at the state of a shell with finite
/// rotations. Forces at constrained nodes have not yet been moved to others (collective).
algebra::Vector load_rate(const DiscreteShell& discrete);

/// Returns the shell linearised at `state` (collective). Throws SupportError, ObstacleError.
std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state = {});

}  // namespace plastron::assembly
