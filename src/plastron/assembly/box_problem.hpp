// The box-constrained program of a discrete shell: the stiffness matrix A = T' (B' C B) T in nodal coordinates, bounds, the
// equations of the mixed formulation, and the forces that press obstacles.
//
// The position of a pressed obstacle is an unknown of the contact problem beside (u, r). The obstacle moves by s along the
// direction d of its force. To first order this closes its gaps by s n . d, as in (M16) with the normals of the
// linearisation.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/contact/problem.hpp>

#include <optional>
#include <span>
#include <vector>

namespace plastron::assembly {

/// Returns the side on which the row bounds its coordinate.
inline contact::Activity bound_of(const ContactRow& row) {
  return row.scale > 0 ? contact::Activity::at_lower : contact::Activity::at_upper;
}

/// Returns the activity of owned coordinates with each bound on its likely side. `zone`: a value for each node and obstacle,
/// above one half if contact is likely.
std::vector<contact::Activity> likely_activity(const NodalCoordinates& coordinates, const algebra::Vector& zone);

/// Marks the owned nodes where lambda = 0. Precondition: the coordinates belong to a relaxed formulation.
std::vector<char> multiplier_zeros(const NodalCoordinates& coordinates, const algebra::Layout& layout);

/// Returns the sum of the cells' matrices in coordinates of this width: of_cell(cell) is the matrix of an owned cell on its
/// sources. It is not finished (collective).
template <class OfCell>
algebra::Matrix sum_over_cells(const fem::Space& space, int width, const OfCell& of_cell) {
  algebra::Matrix matrix(space.layout, width, space.couplings());
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const constraints::NodeColumns k = of_cell(c);
    matrix.add(k.nodes, {k.matrix.data(), static_cast<std::size_t>(k.matrix.size())});
  }
  return matrix;
}
/// Returns the same, finished.
template <class OfCell>
algebra::Matrix matrix_of_cells(const fem::Space& space, int width, const OfCell& of_cell) {
  algebra::Matrix matrix = sum_over_cells(space, width, of_cell);
  matrix.finish();
  return matrix;
}

/// Returns the matrix of a(., .) and of all terms in nodal coordinates (collective).
algebra::Matrix stiffness_matrix(const DiscreteShell& discrete);

/// Returns the matrix of a cell's part of (M8) and of the terms in nodal coordinates, with the strains' derivative at a state.
constraints::NodeColumns material_stiffness(const DiscreteShell& discrete, const NodalCoordinates& coordinates,
                                            std::size_t cell, const energy::CellGeometry& at);

/// Returns the forces of the obstacles in the order of pressed_obstacles().
std::vector<contact::PressingForce> pressing_forces(const NodalCoordinates& coordinates,
                                                    const RigidObstacles& obstacles, const State& state);

/// Returns the program. In the mixed formulation it contains the equations b(U, q) = 0. `matrix` is the shell's
/// stiffness_matrix(). `discrete` and `matrix` must outlive the result (collective).
contact::BoxProblem box_problem(const DiscreteShell& discrete, const algebra::Matrix& matrix);

/// Returns the obstacles that a force presses in the state, by their place in the list. The forces of box_problem() have the
/// same order, and their positions are measured from the obstacles' present positions.
std::vector<std::size_t> pressed_obstacles(const RigidObstacles& obstacles, const State& state);
inline std::vector<std::size_t> pressed_obstacles(const DiscreteShell& discrete) {
  return pressed_obstacles(discrete.obstacles, discrete.state);
}

/// Moves the pressed obstacles by `ways` [m] along their forces, and changes gaps and bounds. The normals stay, as in
/// the linearisation (collective).
void press(DiscreteShell& discrete, std::span<const double> ways);

/// If some node of a bed leaves the segment of the state on the way to a solution (u, r) = `y`: returns the part t of the way at which the
/// potential is least, 0 < t <= 1, where the bed follows its law and other contact forces stay those of the solution. `way`: y less the
/// state, with ghosts. `pressed`: ways of the pressed obstacles that press() has not yet moved (collective).
std::optional<double> part_by_beds(const DiscreteShell& discrete, const algebra::Vector& y, const algebra::Vector& way,
                                   std::span<const double> pressed = {});

}  // namespace plastron::assembly
