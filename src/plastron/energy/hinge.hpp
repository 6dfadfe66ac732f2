// Hinges with a stiffness between joined edges. A spring along the edge resists the change of the angle phi between the directors of
// both sides, in the plane normal to the edge:
//   Pi = 1/2 int k (phi - phi_0)^2 ds,   phi = atan2(|a| a . (d_1 x d_2), (a x d_1) . (a x d_2)),
// a the derivative of the place along the edge, d_i = a_3i + r_i, k [N] and ds those of the reference. With small rotations
// phi - phi_0 is its derivative at the reference, which is theta_2 - theta_1, theta_i = r_i . (t x a_3i), where a . a_3i = 0.
//
// The integral is a sum over the nodes of the edge with the weights of Gauss and Lobatto, exact for degree 2 k - 1. A rigid motion
// costs no energy in either model.
#pragma once
#include <plastron/element/formulation.hpp>
#include <plastron/energy/term.hpp>

#include <Eigen/Core>

namespace plastron::energy {

/// The angle from d_1 to d_2 about a, with its derivatives by (a, d_1, d_2).
struct HingeAngle {
  double value;  ///< in (-pi, pi]
  Eigen::Matrix<double, 9, 1> gradient;
  Eigen::Matrix<double, 9, 9> hessian;
};
HingeAngle hinge_angle(const Eigen::Matrix<double, 9, 1>& vectors);

/// Returns the term of all hinges of a space; null if none has a stiffness (collective). `reference`: (phi, a_3) of the nodes with
/// current ghosts. With finite rotations the angle changes by less than pi.
std::shared_ptr<const Term> hinge_term(const fem::Space& space, const algebra::Vector& reference,
                                       element::Rotations rotations);

}  // namespace plastron::energy
