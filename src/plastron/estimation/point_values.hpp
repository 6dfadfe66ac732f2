// Displacements, resultants and stresses at a point of Omega as functionals. A force at a point has infinite energy
// in Naghdi's model, which grows like a logarithm. A couple and a resultant have infinite energy too, with faster
// growth.
#pragma once
#include <plastron/estimation/derivatives.hpp>

namespace plastron::estimation {

Derivative derivative_of(const PointDisplacement& point, const Solved& solved);
Derivative derivative_of(const PointStress& point, const Solved& solved);
Derivative derivative_of(const LargestStress& stress, const Solved& solved);

}  // namespace plastron::estimation
