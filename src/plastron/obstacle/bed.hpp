// The elastic surface of an obstacle (M33): its pressure is piecewise linear in its closure and rises from 0.
#pragma once
#include <utility>
#include <vector>

namespace plastron::obstacle {

/// A value: the law of a bed. Without a law the obstacle is rigid.
class Bed {
 public:
  /// A line of the law, continued to all closures.
  struct Segment {
    double stiffness = 0;  ///< [N/m^3]
    double shift = 0;      ///< closure at which the line has no pressure [m]

    double pressure(double closure) const { return stiffness * (closure - shift); }
    bool operator==(const Segment&) const = default;
  };

  Bed() = default;
  /// p = stiffness c. Precondition: 0 < stiffness.
  explicit Bed(double stiffness) : Bed(std::vector<std::pair<double, double>>{{0, 0}, {1, stiffness}}) {}
  /// The law through points (closure [m], pressure [Pa]). The last line goes on beyond the last point. Precondition: at least two
  /// points, the first one (0, 0), both numbers rise.
  explicit Bed(const std::vector<std::pair<double, double>>& points);

  bool is_rigid() const { return parts_.empty(); }
  /// Whether the stiffness depends on the closure.
  bool has_segments() const { return parts_.size() > 1; }
  /// Returns the pressure of a closure, 0 where the bed is open [Pa].
  double pressure(double closure) const;
  /// Returns the closure under a pressure, the inverse of pressure() [m].
  double closure(double pressure) const;
  /// Returns the energy under a pressure, int p dc, per area [J/m^2].
  double energy(double pressure) const;
  /// Returns the line at a closure; at a point that of the larger closures, of an open bed the first one.
  const Segment& segment(double closure) const { return part_at(closure).segment; }
  /// Returns the least and the largest stiffness [N/m^3].
  std::pair<double, double> stiffnesses() const;

 private:
  struct Part {
    double closure, pressure, energy;  // at its beginning
    Segment segment;
  };
  const Part& part_at(double closure) const;
  const Part& part_under(double pressure) const;

  std::vector<Part> parts_{};
};

}  // namespace plastron::obstacle
