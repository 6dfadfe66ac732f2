// Totals of a solution: energies, works, resultants, contact of each obstacle, reactions of supports and rigid bodies.
#pragma once
#include <plastron/solution/body_reactions.hpp>
#include <plastron/solution/contact_forces.hpp>
#include <plastron/solution/contact_zone.hpp>
#include <plastron/solution/support_reactions.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace plastron::solution {

/// Contact of one obstacle with the shell.
struct ObstacleContact {
  std::string name{};
  Wrench reaction{};
  double force_norms = 0;      ///< sum of the norms of its nodal forces, which do not cancel [N]
  double area = 0;             ///< mid-surface area within the boundaries of its zones [m^2]
  double bed_energy = 0;       ///< energy of its bed [J]
  double largest_closure = 0;  ///< by which its bed gives [m]
  std::int64_t nodes = 0;      ///< number of nodes that touch it
  Vector3d translation =
      Vector3d::Zero();  ///< displacement of the origin of the shape's own coordinates since the start [m]
  Vector3d rotation = Vector3d::Zero();  ///< rotation since the start: axis times angle [rad]
  /// Smallest gap anywhere between the shell and the obstacle, see certificate::searched_gaps(); infinite if no cell is
  /// near [m].
  double least_gap = std::numeric_limits<double>::infinity();
  std::string least_gap_place{};  ///< its place in words: parameters in Omega, or the position on a mesh in space
  /// Number of nodes pushed along the shell, out of a place deep inside the obstacle.
  std::int64_t sideways_nodes = 0;
  double sideways_part = 0;  ///< part of the reaction at these nodes, without nodes on an edge of the shell
  std::vector<ContactZone>
      zones{};  ///< zones on the finest mesh, see zones::contact_zones(); certify() leaves them empty
};

/// What a foundation or a spring does to the shell.
struct FoundationReaction {
  std::string name{};
  bool is_spring = false;
  Wrench reaction{};
  double energy = 0;  ///< [J]
};

/// Totals of the solution: energies, works, resultants, contact.
struct Summary {
  energy::Energies energy;
  double load_work = 0;  ///< l(U) [J]
  Wrench loads, reaction, support_reaction;
  /// Point about which all moments here are taken, see take_moments_about() [m].
  Vector3d moment_point = Vector3d::Zero();
  double contact_area = 0;               ///< sum of the obstacles' areas [m^2]
  double max_pressure = 0;               ///< max eta_i [Pa]
  double max_normal_rotation = 0;        ///< max |r . a_3| over nodes and quadrature points
  double max_displacement = 0;           ///< max |u| over nodes [m]
  double max_relative_displacement = 0;  ///< max |u| / e over nodes
  double max_rotation = 0;               ///< max |r|, or the angle with finite rotations, over nodes [rad]
  double least_thickness = 0;            ///< min e over nodes [m]
  double size = 0;                       ///< half the diagonal of the nodes' bounding box [m]
  /// Largest principal strain gamma +- e/2 chi at the faces, by absolute value, at quadrature points.
  double max_strain = 0;
  double rounding_energy = 0;  ///< energy that rounding alone may produce [J]
  double rigid_energy = 0;     ///< energy of strains as large as displacements over the shell's size [J]
  double initial_energy = 0;   ///< 1/2 int N_0 : gamma_0 + M_0 : chi_0, the energy of the initial strains [J]
  double tangency_energy = 0;  ///< energy of the penalty or stabilisation [J]
  double multiplier_norm = 0;  ///< (int a^{ab} d_a lambda d_b lambda dS)^{1/2} [N m]; 0 unless mixed
  std::int64_t touching_nodes = 0;
  double load_norms = 0;     ///< sum of |nodal load|, couples divided by the shell's size [N]
  double support_norms = 0;  ///< sum of the norms of nodal forces of supports [N]
  double area_modulus = 0;   ///< int E dS [N]
  /// True if bounds are lifted so that the shell does not enter obstacles between nodes either.
  bool is_admissible_wanted = false;
  double largest_lift = 0;  ///< largest lift of a bound of a gap at a node [m]
  /// Sum of nodal reaction times lift: an upper bound of the increase of 1/2 a(U, U) - l(U) caused by the lifts [J].
  double lift_work = 0;
  /// True if the displacements strain the shell no more than rounding.
  bool is_unstrained = false;
  bool is_in_space = false;  ///< whether the mid-surface is a mesh in space: points then have no parameters
  std::vector<SupportReaction> support_reactions{};  ///< one per boundary
  std::vector<CornerReaction> corner_reactions{};    ///< where supported edges meet
  std::vector<PointReaction> point_reactions{};      ///< at supported points
  std::vector<BodyReaction> body_reactions{};        ///< in the order of the case
  std::vector<FoundationReaction> foundations{};     ///< in the order of the case
  std::vector<ObstacleContact> obstacles{};          ///< in the order of the problem
  EdgeContact edge;                                  ///< part of the contact on edges of the shell

  /// Sum of the forces of all foundations on the shell.
  Wrench foundation_reaction() const;
  /// Sum of the norms of the obstacles' nodal forces [N].
  double contact_norms() const;
  /// The largest sum of norms, of loads, obstacles or supports [N]. Forces that are much smaller vanish.
  double force_scale() const;
  /// Strain that is too small for the model: the one through the thickness under the forces, which the model neglects, and a part of
  /// the initial strains.
  double least_strain() const;
  /// Displacement of this strain over the thickness [m].
  double least_displacement() const { return least_strain() * least_thickness; }
  /// Energy of this strain [J]. The energy of a shell at rest is smaller.
  double least_energy() const;
};

/// Computes the totals, with moments about the origin, from the solution's residual() and body_balance(). What must be
/// searched for an obstacle is left out: area, least gap and nodes pushed sideways, see certificate::certify()
/// (collective).
Summary summarise(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
                  const algebra::Vector& residual, const BodyBalance& bodies);

/// Forces, moments and energies of strains as large as the displacements relative to the shell's size, summed over the
/// nodes. Much smaller ones are rounding.
struct StrainScale {
  double force = 0, squared_force = 0, moment = 0, energy = 0;
};
/// Computes the scale for nodal values y of a shell of this size (collective).
StrainScale strain_scale(const assembly::DiscreteShell& discrete, const algebra::Vector& y, double size);

/// Refers all moments in `summary`, also of contact zones, to `point` [m]. The certificate's balance stays about the
/// origin.
void take_moments_about(const Vector3d& point, Summary& summary);

}  // namespace plastron::solution
