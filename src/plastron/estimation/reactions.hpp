// Forces of obstacles and supports as weighted sums of the multipliers of fixed coordinates.
#pragma once
#include <plastron/estimation/derivatives.hpp>

namespace plastron::estimation {

/// Return the forces of these functionals (collective). The dual is fixed at minus the weights of the multipliers.
Derivative derivative_of(const ObstacleForce& force, const Solved& solved);
Derivative derivative_of(const SupportForce& force, const Solved& solved);

}  // namespace plastron::estimation
