// Forces of obstacles and supports as weighted sums of the multipliers of held coordinates.
#pragma once
#include <plastron/estimation/derivatives.hpp>

namespace plastron::estimation {

/// The forces of these functionals, with minus the weights of multipliers as what the dual is held at (collective).
Derivative derivative_of(const ObstacleForce& force, const Solved& solved);
Derivative derivative_of(const SupportForce& force, const Solved& solved);

}  // namespace plastron::estimation
