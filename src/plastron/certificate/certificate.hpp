// The certificate of a solution (docs/model.md, section 8), recomputed from displacements, strains and bounds alone.
#pragma once
#include <plastron/assembly/second_order.hpp>
#include <plastron/certificate/body_reactions.hpp>
#include <plastron/certificate/contact_zone.hpp>
#include <plastron/certificate/edge_contact.hpp>
#include <plastron/certificate/gap_between.hpp>
#include <plastron/certificate/support_reactions.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace plastron::certificate {

/// Contact of one obstacle with the shell.
struct ObstacleContact {
  std::string name{};
  Wrench reaction{};
  double area = 0;         ///< mid-surface area within the boundaries of its zones [m^2]
  std::int64_t nodes = 0;  ///< number of nodes that touch it
  Vector3d translation =
      Vector3d::Zero();  ///< displacement of the origin of the shape's own coordinates since the start [m]
  Vector3d rotation = Vector3d::Zero();  ///< rotation since the start: axis times angle [rad]
  /// Smallest gap anywhere between the shell and the obstacle, see searched_gaps(); infinite if no cell is near [m].
  double least_gap = std::numeric_limits<double>::infinity();
  Eigen::Vector2d least_gap_at = Eigen::Vector2d::Zero();  ///< parameters in Omega
  /// Number of nodes pushed along the shell, out of a place deep inside the obstacle.
  std::int64_t sideways_nodes = 0;
  double sideways_part = 0;          ///< part of the reaction at these nodes, without nodes on an edge of the shell
  std::vector<ContactZone> zones{};  ///< zones on the finest mesh, see contact_zones(); certify() leaves them empty
};

struct Certificate {
  // The denominators of ratios are at least the rounding of forces, moments and energies, which matters where
  // displacements hardly strain the shell.
  /// |residual on free coordinates| / |loads and reactions|, couples divided by the lever e
  double stationarity = 0;
  double min_pressure = 0;     ///< min eta_i over touching nodes [Pa]
  double min_gap_nodes = 0;    ///< min g_i [m]
  double min_gap_between = 0;  ///< min of the gap between the nodes [m]
  double support_error = 0;    ///< max |u.d - its value| and e |r.d - its value| over prescribed components [m]
  double complementarity = 0;  ///< max |eta_i (g_i - s_i)|, s_i the lift of the bound [Pa m]
  double force_balance = 0;    ///< |loads + obstacle + supports| / sum of the norms of all nodal forces and couples / e
  double moment_balance = 0;   ///< likewise for moments about the origin; decreases with h on curved charts
  double energy_identity = 0;  ///< |a(U,U) - l(U) - sum eta_i (g_i - g_i(0)) - support work| / a(U,U)
};

/// Totals of the solution: energies, works, resultants, contact.
struct Summary {
  assembly::Energies energy;
  double load_work = 0;  ///< l(U) [J]
  Wrench loads, reaction, support_reaction;
  /// Point about which all moments here are taken, see take_moments_about() [m].
  Vector3d moment_point = Vector3d::Zero();
  double contact_area = 0;               ///< sum of the obstacles' areas [m^2]
  double max_pressure = 0;               ///< max eta_i [Pa]
  double max_normal_rotation = 0;        ///< max |r . a_3| over nodes and quadrature points
  double max_displacement = 0;           ///< max |u| over nodes [m]
  double max_relative_displacement = 0;  ///< max |u| / e over nodes
  double max_rotation = 0;               ///< max |r| over nodes [rad]
  double least_thickness = 0;            ///< min e over nodes [m]
  double size = 0;                       ///< half the diagonal of the nodes' bounding box [m]
  /// Terms neglected by linear strains; no work where the shell is not strained.
  assembly::SecondOrder second_order{};
  double rounding_energy = 0;  ///< energy that rounding alone may produce [J]
  double tangency_energy = 0;  ///< energy of the penalty or stabilisation [J]
  double multiplier_norm = 0;  ///< (int a^{ab} d_a lambda d_b lambda dS)^{1/2} [N m]; 0 unless mixed
  std::int64_t touching_nodes = 0;
  double load_norms = 0;  ///< sum of |nodal load|, couples divided by the shell's size [N]
  /// True if bounds are lifted so that the shell does not enter obstacles between nodes either.
  bool is_admissible_wanted = false;
  double largest_lift = 0;  ///< largest lift of a bound of a gap at a node [m]
  /// Sum of nodal reaction times lift: an upper bound of the increase of 1/2 a(U, U) - l(U) caused by the lifts [J].
  double lift_work = 0;
  /// True if the displacements strain the shell no more than rounding.
  bool is_unstrained = false;
  std::vector<SupportReaction> support_reactions{};  ///< one per boundary
  std::vector<CornerReaction> corner_reactions{};    ///< where supported edges meet
  std::vector<PointReaction> point_reactions{};      ///< at supported points
  std::vector<BodyReaction> body_reactions{};        ///< in the order of the case
  std::vector<ObstacleContact> obstacles{};          ///< in the order of the problem
  EdgeContact edge;                                  ///< part of the contact on edges of the shell

  /// Returns an energy divided by the stored one; finite also where the shell moves as a rigid body.
  double over_stored(double part) const {
    const double stored = std::max(energy.total(), rounding_energy);
    return part == 0 ? 0 : part / stored;
  }
};

/// Nodal results of a solution, per local node with valid ghosts.
struct NodalSolution {
  algebra::Vector y;         ///< (u, r), block 6
  algebra::Vector pressure;  ///< eta_i of each obstacle [Pa]; block: number of obstacles, at least 1
  algebra::Vector touching;  ///< 1 where the node touches that obstacle, else 0; same block
  algebra::Vector lambda{};  ///< multiplier of (M14) [N m], block 1; without layout in the other formulations
};

/// The sum over all obstacles at a node.
double total_pressure(const NodalSolution& solution, std::size_t node);
bool touches(const NodalSolution& solution, std::size_t node);

/// Computes eta_i from the residual at the nodes in the solution's active set (collective).
NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const contact::BoxSolution& solution);

struct Verdict {
  Summary summary;
  Certificate certificate;
  std::vector<CellGap> entered{};  ///< this rank's cells with a gap below 0
};
/// Computes the summary and the certificate with moments about the origin (collective).
Verdict certify(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::certificate
