// A contact zone: a connected part of the shell that touches one obstacle, what it carries and where it ends.
//
// Places in space lie on the touching face of the undeformed shell, phi + z a_3, where reactions act in the linear model (M16,
// M19): the moment of a force there is that of the balance. Displacements tell where the face has gone.
#pragma once
#include <plastron/certificate/wrench.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace plastron::certificate {

struct BoundaryPoint {
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< parameters in Omega
  Vector3d place = Vector3d::Zero();            ///< on the touching face [m]
  Vector3d displacement = Vector3d::Zero();     ///< u + z r of that point [m]
};

/// A part of a zone's boundary: inside the shell, where the gap opens, or along the rim, where the shell ends. Lines inside end on the
/// rim or are closed; a closed line's last point is its first.
struct ContactLine {
  bool is_closed = false;
  bool is_rim = false;
  double length = 0;  ///< of the polyline in space [m]
  std::vector<BoundaryPoint> points{};
};

struct ContactZone {
  double area = 0;        ///< of the mid-surface within its boundary [m^2]
  double nodal_area = 0;  ///< of the mid-surface that its nodes stand for [m^2]
  std::int64_t nodes = 0;
  Wrench reaction;                                   ///< on the shell
  Vector3d centre = Vector3d::Zero();                ///< of pressure; of the area where nothing is carried [m]
  double peak_pressure = 0;                          ///< largest eta at a node [Pa]
  Eigen::Vector2d peak_x = Eigen::Vector2d::Zero();  ///< where: parameters in Omega
  Vector3d peak_place = Vector3d::Zero();            ///< where: on the touching face [m]
  std::vector<ContactLine> lines{};                  ///< inside the shell first, then along the rim; long before short

  /// It is narrower than the distance of nodes, a line or a point: pressures at its nodes depend on the mesh.
  bool is_line() const;
  double line_reaction() const;  ///< norm of the force over half the length of its boundary; 0 for a point [N/m]
  double line_length() const;    ///< of the lines inside the shell [m]
  double rim_length() const;     ///< of the lines along the rim [m]
  std::int64_t line_points() const;
};

/// How far the lines inside the shell are from those of other zones: the mean distance along them, over the radius of round zones, twice the area
/// by length of line, or half the width of strips, the area by length of line, if a line ends at the rim. 0 where neither have lines, infinite where one has none.
double relative_distance(std::span<const ContactZone> zones, std::span<const ContactZone> others);

}  // namespace plastron::certificate
