// A spring on a rigid body, as a term of the potential.
#pragma once
#include <plastron/energy/foundation.hpp>

#include <memory>

namespace plastron::energy {

/// Returns the term of a spring on a body; null if all its stiffnesses are 0. Throws LoadError if the space has no such body.
std::shared_ptr<const Term> body_spring(const fem::Space& space, const Foundation& spring,
                                        element::Rotations rotations);

}  // namespace plastron::energy
