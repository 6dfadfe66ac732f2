// A contact zone: a connected part of the shell that touches one obstacle, its reaction and its boundary.
//
// Places in space lie on the touching face of the undeformed shell, phi + z a_3, where reactions act in the linear
// model (M16, M19). The moment of a force there is the moment in the balance. Displacements give the face's motion.
#pragma once
#include <plastron/solution/wrench.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::solution {

struct BoundaryPoint {
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< parameters in Omega
  Vector3d place = Vector3d::Zero();            ///< on the touching face [m]
  Vector3d displacement = Vector3d::Zero();     ///< displacement u + z r of that point [m]
};

/// A part of a zone's boundary: inside the shell, where the gap opens, or along the rim, where the shell ends. Lines
/// inside end on the rim or are closed; the last point of a closed line is its first.
struct ContactLine {
  bool is_closed = false;
  bool is_rim = false;
  double length = 0;  ///< length of the polyline in space [m]
  std::vector<BoundaryPoint> points{};
};

struct ContactZone {
  double area = 0;        ///< mid-surface area within its boundary [m^2]
  double nodal_area = 0;  ///< mid-surface area represented by its nodes [m^2]
  std::int64_t nodes = 0;
  Wrench reaction;  ///< reaction on the shell
  /// Centre of pressure, or of the area where the zone carries no reaction [m].
  Vector3d centre = Vector3d::Zero();
  double peak_pressure = 0;                          ///< largest eta at a node [Pa]
  Eigen::Vector2d peak_x = Eigen::Vector2d::Zero();  ///< place of the peak: parameters in Omega
  Vector3d peak_place = Vector3d::Zero();            ///< place of the peak: on the touching face [m]
  std::vector<ContactLine> lines{};                  ///< inside the shell first, then along the rim; long before short

  /// Whether the zone is narrower than the distance of nodes, a line or a point. Then the pressures at its nodes
  /// depend on the mesh.
  bool is_line() const;
  double line_reaction() const;  ///< norm of the force over half the length of its boundary; 0 for a point [N/m]
  double line_length() const;    ///< length of the lines inside the shell [m]
  double rim_length() const;     ///< length of the lines along the rim [m]
  std::int64_t line_points() const;
};

/// The relative distance of the lines inside the shell from the lines of other zones: the mean distance along them
/// over a radius. If all lines are closed, the radius is the one of round zones, twice the area over the length of
/// line. If a line ends at the rim, it is half the width of strips, the area over the length of line. Returns 0 if
/// neither has lines, infinity if only one has lines.
double relative_distance(std::span<const ContactZone> zones, std::span<const ContactZone> others);

}  // namespace plastron::solution
