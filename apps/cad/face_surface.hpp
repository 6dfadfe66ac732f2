// Feet of perpendiculars on a face's surface, with the face's normals.
#pragma once
#include "part.hpp"

#include <BRep_Tool.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_Surface.hxx>
#include <ShapeAnalysis_Surface.hxx>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace plastron::cad {

using Eigen::Vector2d;

/// A point of a face with its parameters and its normal; no normal at a tip, where the surface has none.
struct FacePoint {
  Vector3d position;
  Vector2d parameters;
  std::optional<Vector3d> normal{};
};

/// The nearest points of a face's surface, which goes on beyond the edges of the face.
class FaceSurface {
 public:
  explicit FaceSurface(const TopoDS_Face& face)
      : surface_(untrimmed(BRep_Tool::Surface(face))),
        analysis_(new ShapeAnalysis_Surface(surface_)),
        sign_(face.Orientation() == TopAbs_REVERSED ? -1 : 1) {
    const GeomAdaptor_Surface adaptor(surface_);
    is_elementary_ = adaptor.GetType() <= GeomAbs_Torus;
    surface_->Bounds(low_[0], high_[0], low_[1], high_[1]);
    if (surface_->IsUPeriodic()) periods_[0] = surface_->UPeriod();
    if (surface_->IsVPeriodic()) periods_[1] = surface_->VPeriod();
    if (const auto sphere = Handle(Geom_SphericalSurface)::DownCast(surface_); !sphere.IsNull()) {
      centre_ = vector_of(sphere->Location());
      if (!sphere->Position().Direct()) centre_sign_ = -1;
    }
  }

  /// Searches on the whole surface.
  FacePoint nearest(const Vector3d& at) const {
    constexpr double precision = 1e-9;
    const gp_Pnt2d uv = analysis_->ValueOfUV(point_of(at), precision);
    const Foot foot = improved(at, {uv.X(), uv.Y()});
    return point(foot.is_found && is_within(foot.parameters) ? foot.parameters : Vector2d(uv.X(), uv.Y()));
  }

  /// Searches from parameters nearby. Search on the whole of a spline takes a thousand times as long.
  FacePoint nearest(const Vector3d& at, const Vector2d& guess) const {
    if (is_elementary_) return nearest(at);
    const Foot foot = improved(at, guess);
    return foot.is_found && is_within(foot.parameters) ? point(foot.parameters) : nearest(at);
  }

  /// The parameters of a point as a continuation of those of another one.
  Vector2d continued(Vector2d parameters, const Vector2d& from) const {
    for (const int k : {0, 1})
      if (periods_[k] > 0) parameters[k] -= periods_[k] * std::round((parameters[k] - from[k]) / periods_[k]);
    return parameters;
  }

  /// The normal at a point of the face; at a tip, of a place nearby in the direction of `inside`.
  Vector3d normal(const Vector3d& at, const Vector2d& guess, const Vector3d& inside) const {
    constexpr double part = 1e-6;
    const FacePoint there = nearest(at, guess);
    if (there.normal) return *there.normal;
    return nearest(at + part * (inside - at)).normal.value_or(Vector3d::Zero());
  }

 private:
  /// Whether a surface that ends has these parameters; the polynomials of a spline go on beyond them, and away from the part.
  bool is_within(const Vector2d& uv) const {
    constexpr double rounding = 1e-7;
    for (const int k : {0, 1})
      if (periods_[k] == 0 &&
          (uv[k] < low_[k] - rounding * (high_[k] - low_[k]) || uv[k] > high_[k] + rounding * (high_[k] - low_[k])))
        return false;
    return true;
  }

  struct Foot {
    Vector2d parameters;
    bool is_found = false;
  };

  /// Newton's method for the foot of the perpendicular.
  Foot improved(const Vector3d& at, Vector2d uv) const {
    constexpr int steps = 12;
    constexpr double converged = 1e-14;
    gp_Pnt p;
    gp_Vec du, dv, duu, dvv, duv;
    Foot foot{uv};
    double first_distance = 0;
    for (int step = 0; step < steps; ++step) {
      surface_->D2(uv[0], uv[1], p, du, dv, duu, dvv, duv);
      const Vector3d r = vector_of(p) - at, a = vector_of(du), b = vector_of(dv);
      const Vector2d gradient(r.dot(a), r.dot(b));
      const double scale = std::max(at.norm(), 1.0);
      foot.is_found =
          std::abs(gradient[0]) <= 1e-9 * scale * a.norm() && std::abs(gradient[1]) <= 1e-9 * scale * b.norm();
      if (foot.is_found) foot.parameters = uv;
      Eigen::Matrix2d h;
      const double mixed = a.dot(b) + r.dot(vector_of(duv));
      h << a.dot(a) + r.dot(vector_of(duu)), mixed, mixed, b.dot(b) + r.dot(vector_of(dvv));
      const double singular = 1e-12 * a.squaredNorm() * b.squaredNorm();
      if (step == 0) first_distance = r.norm();
      const bool is_nearest =
          h(0, 0) > 0 && h.determinant() > singular && r.norm() <= first_distance * (1 + 1e-9) + 1e-12 * scale;
      foot.is_found = foot.is_found && is_nearest;
      if (!(h.determinant() > singular)) break;
      const Vector2d change = -h.inverse() * gradient;
      if (!change.allFinite()) break;
      const double moved = (change[0] * a + change[1] * b).norm();
      uv += change;
      if (moved <= converged * scale) break;
    }
    return foot;
  }

  FacePoint point(const Vector2d& uv) const {
    gp_Pnt p;
    gp_Vec du, dv;
    surface_->D1(uv[0], uv[1], p, du, dv);
    FacePoint found{vector_of(p), uv};
    const Vector3d a = vector_of(du), b = vector_of(dv), normal = a.cross(b);
    constexpr double tip = 1e-9;
    const double longest = std::max(a.squaredNorm(), b.squaredNorm());
    if (centre_)
      found.normal = sign_ * centre_sign_ * (found.position - *centre_).normalized();
    else if (normal.norm() > tip * longest)
      found.normal = sign_ * normal.normalized();
    return found;
  }

  static Handle(Geom_Surface) untrimmed(const Handle(Geom_Surface) & surface) {
    const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
    return trimmed.IsNull() ? surface : trimmed->BasisSurface();
  }

  Handle(Geom_Surface) surface_;
  Handle(ShapeAnalysis_Surface) analysis_;
  double sign_;
  bool is_elementary_ = false;
  std::array<double, 2> low_{}, high_{};  // of the parameters
  std::array<double, 2> periods_{};       // 0: none
  std::optional<Vector3d> centre_{};
  double centre_sign_ = 1;
};

}  // namespace plastron::cad
