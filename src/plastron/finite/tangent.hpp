// The shell with finite rotations (M23-M27) at a state: stresses, forces and tangent stiffness. The unknowns are those of
// the linear model, (u, r); at nodes that nothing constrains the director a_3 + r has length 1.
//
// The Newton steps are those of mixed integration points: stresses are unknowns of a step, so that the geometric stiffness
// takes them from the linearised strains and not from the strains of the state. The latter contain the stretch theta^2/2 that
// a rotation by theta leaves behind; in thin shells it would hide the true stresses (D. Magisano, L. Leonetti,
// G. Garcea: Computer Methods in Applied Mechanics and Engineering 313 (2017) 654-674).
#pragma once
#include <plastron/assembly/box_problem.hpp>

#include <vector>

namespace plastron::finite {

using assembly::CellStrain;

/// A rigid body after a rotation about its reference point and a displacement of it [m].
struct BodyPlace {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

struct State {
  algebra::Vector y{};                 ///< (u, r), block 6, with current ghosts
  std::vector<CellStrain> stresses{};  ///< N, M, Q times area at the quadrature points of owned cells
  /// Couples of contact forces along the directors of owned nodes [N m].
  std::vector<double> contact_couples{};
  std::vector<BodyPlace> bodies{};  ///< places of the rigid bodies
  algebra::Vector touching{};       ///< 1 where a node touches an obstacle, as in solution::NodalSolution
  std::vector<double> positions{};  ///< distances by which forces have moved the obstacles since the start [m]
};

/// Returns (u, r) with directors of length 1 at all nodes except hanging ones, which are interpolated. Rigid bodies take
/// their nodes to their places.
algebra::Vector with_unit_directors(const assembly::DiscreteShell& discrete, algebra::Vector y,
                                    const std::vector<BodyPlace>& bodies = {});

/// Returns the nodal points in their deformed places, with directors as normals. Weights are those of the reference.
std::vector<assembly::NodalPoint> moved_points(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

/// Returns the stresses of strains at quadrature points, less those of initial strains.
CellStrain stresses_of(const assembly::DiscreteShell& discrete, std::size_t cell, const CellStrain& strains);

/// Returns the forces of stresses at a state less the loads, B(y)' S - l, on owned nodes. Forces at constrained nodes have not
/// yet been moved to others. `stresses_at(cell)`: stresses at the cell's quadrature points, times area (collective).
template <class StressesAt>
algebra::Vector unbalanced_forces(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                                  const StressesAt& stresses_at) {
  const assembly::ShellOperator& shell = discrete.shell;
  algebra::Vector f(shell.space().layout, 6);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    shell.scatter(c, shell.forces(c, stresses_at(c), shell.geometry(c, shell.gather(c, y))), f);
    // The loads contain the forces of initial stresses on the reference (load_vector.hpp).
    if (const auto initial = shell.weighted_initial_stresses(c))
      shell.scatter(c, shell.forces(c, discrete.state.load_factor * *initial), f);
  }
  f.accumulate_ghosts();
  algebra::axpy(-1, discrete.load, f);
  return f;
}

/// Returns the forces with the true stresses of the state, which vanish in equilibrium on free coordinates (M29)
/// (collective).
algebra::Vector unbalanced_forces(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

/// Applies the geometric stiffness of stresses to (u, r) of a cell's nodes:
/// int N^{ab} v_a . w_b + M^{ab} (v_a . t_b + w_a . s_b) + Q^a (v_a . t + w_a . s), tied like the strains.
element::CellField geometric_forces(const assembly::ShellOperator& shell, const CellStrain& stresses,
                                    const element::CellField& field);

/// Returns the part of tangent_matrix() that the stresses of the state cause (collective).
algebra::Matrix geometric_matrix(const assembly::DiscreteShell& discrete, const State& state,
                                 const std::vector<assembly::NodalPoint>& points,
                                 const assembly::NodalCoordinates& coordinates);

/// Returns the tangent stiffness (M30) at a state, without the curvature of obstacles, in coordinates on moved_points()
/// (collective).
algebra::Matrix tangent_matrix(const assembly::DiscreteShell& discrete, const State& state,
                               const std::vector<assembly::NodalPoint>& points,
                               const assembly::NodalCoordinates& coordinates);

}  // namespace plastron::finite
