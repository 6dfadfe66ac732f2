#include <plastron/obstacle/gap.hpp>

namespace plastron::obstacle {

Gap gap_at(const Obstacle& obstacle, const ShellPoint& at) {
  const Vector3d n = obstacle.face == Face::nearer ? obstacle.nearest(at.phi + at.u).normal : Vector3d::Zero();
  const double z = face_position(obstacle.face, n, at.a3) * at.thickness;
  const Vector3d point = at.phi + z * at.a3, moved = at.u + z * at.r;
  const Nearest nearest = obstacle.nearest(point + moved);
  return {nearest.distance - nearest.normal.dot(moved), nearest.normal, z, point};
}

double true_gap(const Obstacle& obstacle, const Gap& gap, const ShellPoint& at) {
  return obstacle.nearest(gap.contact_point + at.u + gap.z * at.r).distance;
}

}  // namespace plastron::obstacle
