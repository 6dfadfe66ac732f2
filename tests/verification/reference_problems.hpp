// Problems whose answers are known: plane and axisymmetric contact problems solved to many digits by independent
// one-dimensional methods (reference/README.md), and the classical linear shells. Each comes as a problem::Problem
// together with the numbers it must reproduce.
#pragma once
#include "verification/manufactured.hpp"

#include <plastron/problem/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::verification {

/// A point of the reference solution. `at` is the coordinate on Omega: x of a strip, distance from the axis of a disk.
struct ReferenceRow {
  double at;
  double u_x, u_z;  ///< x: along the strip, or radial [m]
  double r_x, r_z;  ///< [rad]
  double gap;       ///< [m]
  double eta;       ///< reaction per unit mid-surface area [Pa]; at the edge of a zone its limit from inside
  bool touching;    ///< inside the contact zone or at its edge
};

struct ContactReference {
  std::string name;
  problem::Problem problem;
  bool axisymmetric = false;  ///< a disk; otherwise a strip along x
  /// Factor that turns computed values (energies, work, reaction) into the numbers below: 1 / width for a strip, whose
  /// numbers are per unit width of the modelled part, and 1 for a disk.
  double factor = 1;
  double energy = 0, membrane = 0, bending = 0, shear = 0;  ///< [J/m] or [J]
  double load_work = 0;                                     ///< [J/m] or [J]
  double reaction = 0;                                      ///< total force of the obstacle along +z [N/m] or [N]
  std::string pattern;               ///< F free, C contact, from the smallest coordinate to the largest
  std::vector<double> boundaries{};  ///< edges of the contact zones: coordinate on Omega as in ReferenceRow::at
  std::vector<ReferenceRow> rows{};
};

/// The names in the order of the file.
std::vector<std::string> contact_reference_names();
/// The name of a problem in docs/verification.md.
std::string contact_reference_title(const std::string& name);
/// The coarsest mesh of a strip has 8 x 1 square cells; that of a disk is the default of the domain.
ContactReference contact_reference(const std::string& name, int degree, int refinements);

/// Area of the mid-surface between the edges of the contact zones, by Simpson's rule across them. Like the program's area it lacks `factor` [m^2].
double contact_area(const ContactReference& reference);

/// The strip "R1_e..._P3" of any thickness in closed form: energy, work, reaction and edges of the zone, but no parts of the energy and no rows.
ContactReference pressed_strip(double thickness, int degree, int refinements);

/// The problem of a manufactured solution: clamped all round, with its loads, and with the plane x3 = 0 for the contact
/// solution.
problem::Problem manufactured_problem(const Manufactured& exact, int degree, int refinements);

/// A linear shell with one point whose displacement is known.
struct LinearReference {
  std::string name;
  problem::Problem problem;        ///< its only probe is the reference point
  Eigen::Vector3d direction;       ///< the displacement is u(probe) . direction
  double displacement = 0;         ///< [m]
  std::optional<double> energy{};  ///< of the part that is modelled [J]
};

enum class ShearCorrection { one, five_sixths };

/// z = x^2 - y^2, clamped at x = -1/2, own weight; thickness 1e-2, 1e-3 or 1e-4. The numbers of 1e-3 and 1e-4 come from runs of degree 8
/// with 345 000 to 540 000 unknowns, whose errors are below 1e-6 by estimate. With `half` the part y >= 0 and symmetry.
LinearReference hyperbolic_paraboloid(double thickness, ShearCorrection k, bool half, int degree, int refinements);
/// x^2 + y^2 = 1 + z^2 with free ends under a periodic normal load, one eighth of it; thickness 0.1 or 0.01.
LinearReference free_hyperboloid(double thickness, ShearCorrection k, int degree, int refinements);
/// The roof on hard or soft diaphragms, one quarter of it.
LinearReference scordelis_lo(ShearCorrection k, bool hard_diaphragm, int degree, int refinements);
/// Unit square under uniform load in multiples of q L^4 / D, one quarter of it; thickness 0.1 or 0.01.
LinearReference clamped_plate(double thickness, ShearCorrection k, int degree, int refinements);

/// z = c (x^2 - y^2) / (2 b^2) on |x| + |y| < b sqrt(2), clamped all round, vertical load 0.01 per unit mid-surface area, e = 0.8,
/// k_s = 1. Source: Blouza, Hecht and Le Dret, Two finite element approximations of Naghdi's shell model in Cartesian
/// coordinates (2006); the value at the centre was computed to six digits with exact geometry.
LinearReference clamped_saddle(int degree, int refinements);

}  // namespace plastron::verification
