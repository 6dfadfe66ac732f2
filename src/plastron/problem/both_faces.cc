#include <plastron/problem/both_faces.hpp>

namespace plastron::problem {

std::array<obstacle::Obstacle, 2> for_both_faces(const obstacle::Obstacle& body) {
  std::array<obstacle::Obstacle, 2> both{body, body};
  for (obstacle::Obstacle& one : both) one.is_for_both = true;
  both[0].name += of_lower_face;
  both[0].face = obstacle::Face::lower;
  both[1].name += of_upper_face;
  both[1].face = obstacle::Face::upper;
  return both;
}

}  // namespace plastron::problem
