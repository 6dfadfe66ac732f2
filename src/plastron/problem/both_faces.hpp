// An obstacle that both faces may touch is two obstacles. The front program reads cases with this alone, without the solver.
#pragma once
#include <plastron/obstacle/obstacle.hpp>

#include <array>

namespace plastron::problem {

/// Ends of the names of an obstacle that both faces may touch.
inline constexpr const char *of_lower_face = ", lower face", *of_upper_face = ", upper face";
/// Returns an obstacle that both faces may touch as two obstacles: for the lower face, and for the upper one.
std::array<obstacle::Obstacle, 2> for_both_faces(const obstacle::Obstacle& body);

}  // namespace plastron::problem
