// A curve of a part by its parameter.
#pragma once
#include "part.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <ShapeAnalysis_Curve.hxx>

#include <algorithm>
#include <array>
#include <cmath>

namespace plastron::cad {

class EdgeCurve {
 public:
  explicit EdgeCurve(const TopoDS_Edge& edge)
      : curve_(edge),
        is_closed_(curve_.Value(curve_.FirstParameter()).Distance(curve_.Value(curve_.LastParameter())) <=
                   1e-9 + 2 * BRep_Tool::Tolerance(edge)) {}

  Vector3d at(double t) const { return vector_of(curve_.Value(t)); }
  double nearest(const Vector3d& point) const {
    gp_Pnt projected;
    double t = 0;
    ShapeAnalysis_Curve().Project(curve_, point_of(point), 1e-9, projected, t);
    return std::clamp(t, curve_.FirstParameter(), curve_.LastParameter());
  }
  /// Parameters of the ends of a line on the curve.
  std::array<double, 2> ends(const Vector3d& a, const Vector3d& b) const {
    std::array<double, 2> t{nearest(a), nearest(b)};
    const double first = curve_.FirstParameter(), last = curve_.LastParameter(), half = (last - first) / 2;
    if (!is_closed_ || std::abs(t[1] - t[0]) <= half) return t;
    // One end is where the curve closes: there both ends of the curve are meant.
    const int low = t[0] < t[1] ? 0 : 1;
    const bool low_is_end = t[low] - first < last - t[1 - low];
    (low_is_end ? t[low] : t[1 - low]) = low_is_end ? last : first;
    return t;
  }

  /// The direction in which the piece from a to b begins.
  Vector3d direction(const Vector3d& a, const Vector3d& b) const {
    constexpr double part = 0.02;
    const auto t = ends(a, b);
    return (at((1 - part) * t[0] + part * t[1]) - at(t[0])).normalized();
  }

 private:
  BRepAdaptor_Curve curve_;
  bool is_closed_;
};

}  // namespace plastron::cad
