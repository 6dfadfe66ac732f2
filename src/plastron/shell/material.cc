#include <plastron/shell/material.hpp>

namespace plastron::shell {

Eigen::Matrix3d elasticity(const Isotropic& material, const Eigen::Matrix2d& metric_con) {
  constexpr int first[3] = {0, 1, 0}, second[3] = {0, 1, 1};
  const double l = material.lambda_plane_stress();
  const auto& g = metric_con;
  Eigen::Matrix3d c;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      const int a = first[p], b = second[p], r = first[q], s = second[q];
      c(p, q) = l * g(a, b) * g(r, s) + material.mu * (g(a, r) * g(b, s) + g(a, s) * g(b, r));
    }
  return c;
}

Section section_at(const Material& material, const geometry::Frame& frame, double thickness,
                   const InitialState& initial) {
  if (const Isotropic* isotropic = material.isotropic()) {
    const Eigen::Matrix3d c = elasticity(*isotropic, frame.metric_con);
    const double e = thickness;
    Section section{.membrane = e * c,
                    .bending = e * e * e / 12 * c,
                    .shear = material.shear_correction * e * isotropic->mu * frame.metric_con};
    if (initial.is_heated() && isotropic->expansion != 0) {
      const auto& a = frame.metric_cov;
      const Vector3d per_kelvin = isotropic->expansion * Vector3d(a(0, 0), a(1, 1), 2 * a(0, 1));
      section.initial_force = section.membrane * (initial.temperature * per_kelvin);
      section.initial_moment = section.bending * (initial.difference / e * per_kelvin -
                                                  isotropic->expansion * initial.temperature * initial.curvature);
    }
    return section;
  }
  const auto laminate = material.laminate();
  return laminate->section(laminate->axes(frame), thickness, material.shear_correction, initial);
}

geometry::Frame orthonormal_frame(const Vector3d& t1, const Vector3d& t2) {
  const Vector3d zero = Vector3d::Zero();
  return geometry::frame_at({.value = zero, .d = {t1, t2}, .dd = {zero, zero, zero}});
}

geometry::Frame frame_across(const Vector3d& tangent, const Vector3d& a3) {
  return orthonormal_frame(tangent.cross(a3), tangent);
}

}  // namespace plastron::shell
