// The shell with finite rotations (M23-M27) at a state: stresses, forces and tangent stiffness. The unknowns are those of
// the linear model, (u, r); at nodes that nothing constrains the director a_3 + r has the length of a_3.
//
// The Newton steps are those of mixed integration points: stresses are unknowns of a step, so that the geometric stiffness
// takes them from the linearised strains and not from the strains of the state. The latter contain the stretch theta^2/2 that
// a rotation by theta leaves behind; in thin shells it would hide the true stresses (D. Magisano, L. Leonetti,
// G. Garcea: Computer Methods in Applied Mechanics and Engineering 313 (2017) 654-674).
#pragma once
#include <plastron/assembly/box_problem.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::finite {

using energy::CellStrain;

/// Data that a step with mixed integration points takes from the step before.
struct Prestress {
  std::vector<CellStrain> stresses{};  ///< N, M, Q times area at the quadrature points of owned cells
  algebra::Vector contact_forces{};    ///< forces and couples of obstacles on owned nodes (block 6)
  algebra::Vector forces_of_terms{};   ///< derivative of the terms that are not on rigid bodies, likewise
  bool is_exact =
      false;  ///< compressive N, and M, act at the points of their own strains: the derivative of the residual
};

/// Adds the force of a contact row at a node to `forces` (block 6).
void add_contact_force(double force, const obstacle::Gap& gap, std::size_t node, algebra::Vector& forces);

/// Returns no stresses and contact forces: the tangent stiffness is then that of the material.
Prestress no_prestress(const assembly::DiscreteShell& discrete);

/// Returns the stresses and the contact forces of a solution.
Prestress prestress(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Applies the geometric stiffness of stresses to (u, r) of a cell's nodes:
/// int N^{ab} v_a . w_b + M^{ab} (v_a . t_b + w_a . s_b) + Q^a (v_a . t + w_a . s), tied like the strains; but where these are tied,
/// compressive N, and M, are taken at fewer points, so that cells do not buckle in motions that the tied strains do not see.
element::CellField geometric_forces(const energy::ShellOperator& shell, const CellStrain& stresses,
                                    const element::CellField& field);

/// Returns the part of tangent_matrix() that the material causes, the linear stiffness where the shell is undeformed
/// (collective).
algebra::Matrix material_matrix(const assembly::DiscreteShell& discrete, const assembly::NodalCoordinates& coordinates);

/// Returns the part of tangent_matrix() that the prestress causes (collective).
algebra::Matrix geometric_matrix(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                                 const assembly::NodalCoordinates& coordinates);

/// Returns the tangent stiffness (M30) at the state of the shell, or of its reference with small rotations, without the
/// curvature of obstacles (collective).
algebra::Matrix tangent_matrix(const assembly::DiscreteShell& discrete, const Prestress& prestress,
                               const assembly::NodalCoordinates& coordinates);

/// Computes f = K z for the tangent stiffness, its material part through strains. The product of the assembled matrix loses the
/// bending stiffness of very thin shells in the rounding of the membrane stiffness. `geometric`: geometric_matrix(). The ghosts of z
/// are current (collective).
void multiply_through_strains(const assembly::DiscreteShell& discrete, const algebra::Matrix& geometric,
                              const algebra::Vector& z, algebra::Vector& f);

/// Adds the curvature of obstacles at touching nodes, -eta w (v + z s)' H (v + z s), H the Hessian of the distance. Edges that
/// are sharper than half the thickness count as rounded by it (collective). Throws ObstacleError.
void add_curvature_of_obstacles(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                                algebra::Matrix& matrix);

/// Returns the second derivative of the potential on the face of touching nodes at a solution (M30) (collective). Throws
/// ObstacleError.
algebra::Matrix hessian(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                        const assembly::NodalCoordinates& coordinates);

/// Returns the matrix of the shell's own equations at a solution: hessian(), or stiffness_matrix() where these are linear (collective).
/// Throws ObstacleError.
algebra::Matrix derivative_at(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

}  // namespace plastron::finite
