// A scalar function of a point of space, written by the user as text in X, Y, Z. Its derivatives are exact (GiNaC)
// and evaluated fast (muParser).
#pragma once
#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/jet.hpp>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plastron::geometry {

struct SpaceJet {
  double value = 0;
  Vector3d gradient = Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

/// f(X, Y, Z). Known names: X, Y, Z, pi, the constants and the smooth functions of expressions. Copies share one
/// program, which stores the point of evaluation; they must not be used by several threads at once.
class SpaceFunction {
 public:
  /// Throws ExpressionError or NotDifferentiable.
  SpaceFunction(std::string text, const Constants& constants);

  double value(const Vector3d& X) const;
  /// Returns the value with first and second derivatives.
  SpaceJet operator()(const Vector3d& X) const;
  /// The same at many points. A given function is called for thousands of points at once.
  std::vector<double> values(std::span<const Vector3d> X) const;
  std::vector<SpaceJet> jets(std::span<const Vector3d> X) const;

  /// Whether the derivative along axis 0, 1 or 2 is not identically zero.
  bool depends_on(int axis) const { return depends_on_[static_cast<std::size_t>(axis)]; }
  const std::string& text() const { return text_; }

 private:
  struct Program;
  std::string text_;
  std::array<bool, 3> depends_on_{};
  std::shared_ptr<Program> program_;
};

}  // namespace plastron::geometry
