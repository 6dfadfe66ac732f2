// A shell on one mesh, linearised at a state and ready to be solved: strains, nodal coordinates with their bounds,
// loads.
//
// With small rotations only the gaps depend on the state, and coordinates are those of (u, r). With finite rotations (M23-M29)
// coordinates are those of increments from the state, on the deformed shell: at a solution they are 0.
#pragma once
#include <plastron/assembly/description.hpp>
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/energy/load_vector.hpp>
#include <plastron/energy/shell_operator.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/geometry/frame.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace plastron::assembly {

/// Kind of a field (u, r). A solution has the strains of the model. A motion, such as a dual solution, has their derivative at
/// the state. With small rotations both are the same.
enum class FieldKind { solution, motion };

struct DiscreteShell {
  energy::ShellOperator shell;
  std::vector<NodalPoint> points;
  std::vector<energy::LoadPart> loads;
  energy::Terms terms{};  ///< of the potential, besides the strain energy
  /// The foundations of the description, each with its term; null where its stiffness is 0.
  std::vector<std::pair<energy::Foundation, std::shared_ptr<const energy::Term>>> foundations;
  RigidObstacles obstacles_at_start;
  element::Tangency tangency;
  std::vector<Support> all_supports{};
  element::Rotations rotations = element::Rotations::small;

  // Data of the state:
  State state{};
  std::vector<Support> supports{};  ///< those that are not released
  RigidObstacles obstacles{};
  NodalCoordinates coordinates{};
  algebra::Vector load{};                ///< Cartesian nodal forces and couples of all loads (block 6)
  algebra::Vector initial_forces{};      ///< forces of the initial strains on the undeformed shell (block 6)
  std::vector<NodalPoint> moved{};       ///< moved_points() of the state; empty with small rotations
  std::vector<fem::BodyPlace> places{};  ///< places of the rigid bodies in the state; empty with small rotations

  const fem::Space& space() const { return shell.space(); }
  /// Block of vectors with a value for each obstacle, at least 1.
  int obstacle_block() const { return std::max(1, static_cast<int>(obstacles_at_start.all.size())); }
  bool has_finite_rotations() const { return rotations == element::Rotations::finite; }
  // Properties of the model. Code outside of energy, assembly and finite asks for these and not for the model:
  /// Whether strains, and the forces of the shell, are linear in (u, r).
  bool has_linear_strains() const { return !has_finite_rotations(); }
  /// Whether coordinates are those of increments from the state, and 0 at a solution; else they are those of (u, r).
  bool has_increments() const { return has_finite_rotations(); }
  /// Whether there may be several equilibria, of which some are not stable and the path of the loads decides.
  bool depends_on_path() const { return has_finite_rotations(); }
  /// Changes the model, and the terms with it. linearise() must follow (collective).
  void set_rotations(element::Rotations model);
  /// Returns the node where forces act and directions are taken: of the deformed shell if rotations are finite.
  const NodalPoint& place(std::size_t node) const { return present_points()[node]; }
  /// Returns the same of all local nodes.
  const std::vector<NodalPoint>& present_points() const { return has_finite_rotations() ? moved : points; }
  /// Returns the angle between a_3 and the director a_3 + r; |r| with small rotations [rad].
  double angle(const Vector3d& a3, const Vector3d& r) const;
  /// Returns the part of r that moves the faces: with small rotations the tangential one.
  Vector3d turning(const Vector3d& r, const Vector3d& a3) const {
    return has_finite_rotations() ? r : geometry::tangential(r, a3);
  }
  /// Returns the motion of a rigid body since the start (collective).
  fem::BodyMotion body_motion(std::size_t body, const algebra::Vector& y) const;
  /// Returns (u, r) of a node of a rigid body after its motion, that of the state with finite rotations.
  Vector6 carried(std::size_t body, const fem::BodyNode& member, const fem::BodyMotion& motion) const;
  /// Returns the place where force and moment act on a rigid body: its reference point, moved with finite rotations [m].
  Vector3d reference_of_body(std::size_t body) const;
  /// Returns the part of (u, r) at a node that the coordinates describe.
  Vector6 in_coordinates(const algebra::Vector& y, std::size_t node) const {
    return has_finite_rotations() ? Vector6(node_values(y, node) - state.at(node)) : node_values(y, node);
  }
  /// Returns (u, r) of a cell's nodes at which strains(field) are linearised; nothing with small rotations.
  std::optional<element::CellField> linearised_at(FieldKind kind, std::size_t cell,
                                                  const element::CellField& field) const;
  /// Returns the vectors by which the strains of motions depend on a cell: of the state, or of the undeformed shell if rotations
  /// are small.
  energy::CellGeometry geometry(std::size_t cell) const;
  /// Returns the strains at the quadrature points of a cell with nodal values y.
  energy::CellStrain strains(std::size_t cell, const algebra::Vector& y) const;
  /// Returns N, M, Q of strains at the quadrature points, times area, less those of initial strains.
  energy::CellStrain stresses(std::size_t cell, const energy::CellStrain& strains) const;
  /// Returns the stored energy of a solution: of the stresses, W = 1/2 (eps - eps_0) . C (eps - eps_0), and of the terms that are not
  /// artificial (collective) [J].
  energy::Energies energies(const algebra::Vector& y) const;
  /// Returns the same of strains that follow, where `strains_at` are those of the cells. Terms are those of y (collective) [J].
  energy::Energies energies_of(const std::function<energy::CellStrain(std::size_t cell)>& strains_at,
                               const algebra::Vector& y) const;
  /// Returns the parts of 1/2 a(y, y) for a motion y, with all terms that are not artificial, a with the stiffness of the material at
  /// the state (collective) [J].
  energy::Energies motion_energies(const algebra::Vector& y) const;
  /// Whether some load follows the shell.
  bool has_follower_pressure() const;
  /// Returns the following pressures on a cell at the factors of the state, times quadrature weight. The result is empty on a cell without
  /// such loads, and with small rotations.
  Eigen::VectorXd follower_pressure(std::size_t cell) const;
  /// Returns a point of the shell after a motion (u, r). With small rotations r . a_3 moves no face.
  obstacle::ShellPoint shell_point(const Vector3d& phi, const Vector3d& a3, double thickness,
                                   const Vector6& motion) const;
  /// Returns the energy of the artificial terms, or of the others (collective) [J].
  double energy_of_terms(const algebra::Vector& y, bool are_artificial) const;
  /// Computes f = A y through strains, including all terms. Needs y's ghosts (collective).
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
  /// Returns by how much fields (u, r) enter the obstacle of a row, its lift included: the closure of its bed where that touches [m].
  double entry(const ContactRow& row, const algebra::Vector& y) const {
    const auto k = static_cast<std::size_t>(row.obstacle);
    return state.lift(row.node, k) - nodal_gap(k, row.node, y);
  }
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
/// the loads. With finite rotations directors keep their lengths, and the loads of rigid bodies turn with them; the state has a
/// displacement afterwards, zero if it had none (collective). Throws SupportError, ObstacleError, energy::LoadError.
void linearise(DiscreteShell& discrete, State state);

/// Returns the forces of stresses, B' S, on owned nodes. Forces at constrained nodes have not yet been moved to others.
/// `stresses_of(cell)`: stresses at the cell's quadrature points, times area; `geometry_of(cell)`: that of B (collective).
template <class StressesOf, class GeometryOf>
algebra::Vector forces_of_stresses(const energy::ShellOperator& shell, const StressesOf& stresses_of,
                                   const GeometryOf& geometry_of) {
  algebra::Vector f(shell.space().layout, 6);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c)
    shell.scatter(c, shell.forces(c, stresses_of(c), geometry_of(c)), f);
  f.accumulate_ghosts();
  return f;
}

/// Returns the forces at y of the terms on rigid bodies, or of the others, complete on owned nodes (collective).
algebra::Vector forces_of_terms(const DiscreteShell& discrete, const algebra::Vector& y, bool are_on_bodies);

/// Adds the stiffness of beds, hinges and springs on rigid bodies at the state to a matrix that is not finished (collective).
void add_springs(const DiscreteShell& discrete, const NodalCoordinates& coordinates, algebra::Matrix& matrix);
/// Adds the derivative of the forces of all terms at the state along a motion y, complete on owned nodes (collective).
void add_product_of_terms(const DiscreteShell& discrete, const algebra::Vector& y, algebra::Vector& f);

/// Returns the derivative of the potential without loads at (u, r) = y, like forces_of_stresses() (collective).
algebra::Vector forces_of_energy(const DiscreteShell& discrete, const algebra::Vector& y);

/// Returns the loads at owned nodes with the forces of initial strains on the undeformed shell.
algebra::Vector loads_and_initial_forces(const DiscreteShell& discrete);

/// Returns the derivative of loads less internal forces by the load factor on owned nodes, at the state of a shell with finite
/// rotations. Forces at constrained nodes have not yet been moved to others (collective).
algebra::Vector load_rate(const DiscreteShell& discrete);

/// Returns the shell linearised at `state` (collective). Throws SupportError, ObstacleError.
std::unique_ptr<DiscreteShell> discretise(std::shared_ptr<const fem::Space> space,
                                          std::shared_ptr<const fem::Surface> surface,
                                          const ShellDescription& description, State state = {});

}  // namespace plastron::assembly
