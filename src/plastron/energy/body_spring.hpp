// A spring on a rigid body, as a term of the potential.
#pragma once
#include <plastron/element/formulation.hpp>
#include <plastron/energy/term.hpp>

#include <Eigen/Core>

#include <memory>

namespace plastron::energy {

/// Returns the term of a spring on a body of the space: its stiffness [N/m] and that of its rotation [N m/rad], symmetric and not
/// negative, by the global axes.
std::shared_ptr<const Term> body_spring(std::size_t body, const Eigen::Matrix3d& stiffness,
                                        const Eigen::Matrix3d& of_rotation, element::Rotations rotations);

}  // namespace plastron::energy
