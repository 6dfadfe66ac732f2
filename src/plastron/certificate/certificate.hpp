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

/// What one obstacle does to the shell.
struct ObstacleContact {
  std::string name{};
  Wrench reaction{};
  double area = 0;         ///< of the mid-surface within the boundaries of its zones [m^2]
  std::int64_t nodes = 0;  ///< that touch it
  Vector3d translation =
      Vector3d::Zero();  ///< from where it stood at the start, of the origin of its shape's own coordinates [m]
  Vector3d rotation = Vector3d::Zero();  ///< from how it stood: axis times angle [rad]
  /// Smallest gap anywhere between the shell and the obstacle, see searched_gaps(); infinite if no cell is near [m].
  double least_gap = std::numeric_limits<double>::infinity();
  Eigen::Vector2d least_gap_at = Eigen::Vector2d::Zero();  ///< parameters in Omega
  std::int64_t sideways_nodes = 0;   ///< that it pushes along the shell, out of a place that lay deep inside of it
  double sideways_part = 0;          ///< of the reaction, at those of them that are not on an edge of the shell
  std::vector<ContactZone> zones{};  ///< see contact_zones(); of the finest mesh, for certify() leaves them out
};

struct Certificate {
  // Where displacements strain the shell no more than rounding does, forces count beside those that they would need as strains.
  /// |residual on free coordinates| / |loads and reactions|, couples counted by the force that they are on a lever of e
  double stationarity = 0;
  double min_pressure = 0;     ///< min eta_i over touching nodes [Pa]
  double min_gap_nodes = 0;    ///< min g_i [m]
  double min_gap_between = 0;  ///< min of the gap between the nodes [m]
  double support_error = 0;    ///< max |u.d - its value| and e |r.d - its value| over prescribed components [m]
  double complementarity = 0;  ///< max |eta_i (g_i - s_i)|, s_i the lift of the bound [Pa m]
  double force_balance = 0;    ///< |loads + obstacle + supports| / sum of the norms of all nodal forces and couples / e
  double moment_balance = 0;   ///< likewise for moments about the origin; falls with h on curved charts
  double energy_identity = 0;  ///< |a(U,U) - l(U) - sum eta_i (g_i - g_i(0)) - support work| / a(U,U)
};

/// What the solution weighs: energies, works, resultants, contact.
struct Summary {
  assembly::Energies energy;
  double load_work = 0;  ///< l(U) [J]
  Wrench loads, reaction, support_reaction;
  Vector3d moment_point = Vector3d::Zero();  ///< that all moments here are about, see take_moments_about() [m]
  double contact_area = 0;                   ///< sum of the obstacles' [m^2]
  double max_pressure = 0;                   ///< max eta_i [Pa]
  double max_normal_rotation = 0;            ///< max |r . a_3| over nodes and quadrature points
  double max_displacement = 0;               ///< max |u| over nodes [m]
  double max_relative_displacement = 0;      ///< max |u| / e over nodes
  double max_rotation = 0;                   ///< max |r| over nodes [rad]
  double least_thickness = 0;                ///< min e over nodes [m]
  double size = 0;                           ///< half the diagonal of the box that holds the nodes [m]
  assembly::SecondOrder second_order{};      ///< what linear strains leave out; no work where the shell is not strained
  double rounding_energy = 0;                ///< what rounding alone may store [J]
  double tangency_energy = 0;                ///< energy of the penalty or stabilisation [J]
  double multiplier_norm = 0;                ///< (int a^{ab} d_a lambda d_b lambda dS)^{1/2} [N m]; 0 unless mixed
  std::int64_t touching_nodes = 0;
  double load_norms = 0;              ///< sum of |nodal load|, couples over the shell's size [N]
  bool is_admissible_wanted = false;  ///< bounds are lifted so that the shell is out between nodes, too
  double largest_lift = 0;            ///< of the bounds of gaps at nodes [m]
  /// sum of nodal reaction times lift: what 1/2 a(U, U) - l(U) is above its least without lifts, at most [J]
  double lift_work = 0;
  bool is_unstrained = false;                        ///< displacements strain the shell no more than rounding does
  std::vector<SupportReaction> support_reactions{};  ///< boundary by boundary
  std::vector<CornerReaction> corner_reactions{};    ///< where supported edges meet
  std::vector<PointReaction> point_reactions{};      ///< of the points that supports hold
  std::vector<BodyReaction> body_reactions{};        ///< of the rigid bodies, in the case's order
  std::vector<ObstacleContact> obstacles{};          ///< one by one, in the problem's order
  EdgeContact edge;                                  ///< what of the contact lies on edges of the shell

  /// An energy over the stored one, finite also where the shell moves as a rigid body.
  double over_stored(double part) const {
    const double stored = std::max(energy.total(), rounding_energy);
    return part == 0 ? 0 : part / stored;
  }
};

/// Nodal results of a solution, per local node with valid ghosts.
struct NodalSolution {
  algebra::Vector y;         ///< (u, r), block 6
  algebra::Vector pressure;  ///< eta_i of each obstacle [Pa]; block: obstacles, 1 without
  algebra::Vector touching;  ///< 1 where the node touches that obstacle, else 0; block likewise
  algebra::Vector lambda{};  ///< multiplier of (M14) [N m], block 1; without layout in the other formulations
};

/// The sum over all obstacles at a node; 1 where any is touched.
double total_pressure(const NodalSolution& solution, std::size_t node);
bool touches(const NodalSolution& solution, std::size_t node);

/// eta_i from the residual at the nodes that the solution's activity puts at their bound (collective).
NodalSolution nodal_solution(const assembly::DiscreteShell& discrete, const contact::BoxSolution& solution);

struct Verdict {
  Summary summary;
  Certificate certificate;
  std::vector<CellGap> entered{};  ///< this rank's cells with a gap below 0
};
/// With moments about the origin (collective).
Verdict certify(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

}  // namespace plastron::certificate
