// The chart phi : Omega -> R^3 given by three expressions in x, y and named constants.
// First and second derivatives are exact (GiNaC) and evaluated fast (muParser).
#pragma once
#include <plastron/geometry/expression.hpp>
#include <plastron/geometry/jet.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace plastron::geometry {

/// A displacement of a chart, in expressions of x and y with two derivatives.
struct ChartDisplacement {
  std::array<std::string, 3> cartesian{"0", "0", "0"};  ///< [m]
  std::string normal = "0";  ///< along the unit normal of the chart without displacements [m]
};

class Chart {
 public:
  /// The sum of the components and the displacements. Throws ExpressionError. Given functions cannot be displaced.
  Chart(const std::array<std::string, 3>& components, const Constants& constants,
        const std::vector<ChartDisplacement>& displacements = {});

  /// phi with first and second derivatives with respect to x and y.
  SurfaceJet operator()(double x, double y) const;
  /// Writes jets[i] at (x[i], y[i]). Second derivatives stay zero unless requested.
  void evaluate(std::span<const double> x, std::span<const double> y, std::span<SurfaceJet> jets,
                bool second_derivatives = true) const;

  /// Returns the components without displacements.
  const std::array<std::string, 3>& components() const { return components_; }

 private:
  std::array<std::string, 3> components_;
  std::array<std::vector<Expression>, 3> derivatives_;           // value, 1, 2, 11, 12, 22 of each component
  std::array<std::shared_ptr<const GivenFunction>, 3> given_{};  // components that are given functions
};

}  // namespace plastron::geometry
