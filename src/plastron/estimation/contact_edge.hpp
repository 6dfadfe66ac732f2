// Contribution of a contact zone's edge to the error of a functional. The edge lies at an unknown place in the cells
// that it crosses, where the reaction jumps and no field is smooth. Two terms there are products of multipliers and
// errors of nodal values between the nodes,
//   < mu, g(u_h) >   and   < eta, B z_h - w >,
// mu and eta the reactions of dual and solution, g(u_h) the gap, w the values at which the dual is fixed. Like the
// product of strain errors, they are known by size, not by sign (docs/methods/estimates.md). A true line of contact
// lies between nodes. There the approximate shell penetrates the obstacle beside the row of touching nodes. Nodal
// quadrature does not include this, so both terms are evaluated at the deepest point. A pressed obstacle follows the
// shell: a depth that is the same everywhere changes its position, and no term contains it.
#pragma once
#include <plastron/estimation/derivatives.hpp>
#include <plastron/solution/contact_width.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace plastron::estimation {

/// Shares of the crossed cells, all non-negative.
struct EdgeShares {
  explicit EdgeShares(std::size_t cells) : all(cells, 0), lines(cells, 0) {}
  std::vector<double> all;    ///< largest of all terms
  std::vector<double> lines;  ///< shares of lines of contact alone
};

class ContactEdge {
 public:
  explicit ContactEdge(const Solved& solved);

  /// Owned cells in which some nodes touch an obstacle and some do not, ascending. A line reaction shows that the
  /// shell stands on its rim. Then a cell that touches only with nodes of the rim has no edge inside. It counts as
  /// crossed only if the line ends on one of its sides.
  const std::vector<std::size_t>& crossed() const { return crossed_; }
  /// Number of touching nodes of each crossed cell, for the first obstacle whose zone's edge crosses it. The edge's
  /// place between nodes determines the sign of its contribution. Cells with the same number err in the same
  /// direction, as all cells along a straight edge do; other cells err independently.
  const std::vector<std::size_t>& touching_nodes() const { return touching_nodes_; }
  /// The direction, 0 or 1, of each crossed cell along which more pairs of neighbouring nodes differ in touching: the
  /// edge runs across it. 0 in triangles.
  const std::vector<int>& across() const { return across_; }
  /// For each crossed cell whose free nodes all touch: the mean place in [0, 1] along its direction across() between
  /// touching nodes and nodes that supports hold.
  const std::vector<std::optional<double>>& at_support() const { return at_support_; }
  /// Whether the reaction of a sharp edge of an obstacle acts inside of a cell of any rank: polynomials have no kink there.
  bool has_kinks() const { return has_kinks_; }
  /// Returns the shares for a dual solution. `y` are its Cartesian values (collective).
  EdgeShares shares(const Derivative& derivative, const DualSolution& dual, const algebra::Vector& y) const;

 private:
  struct Dual {
    const Derivative& derivative;
    const algebra::Vector& y;
    std::vector<double> mu{};         ///< its reactions by local node and obstacle, per unit area
    std::vector<double> positions{};  ///< of all obstacles along their forces
  };
  /// The two products at a point (contact_edge.cc).
  struct Products {
    double penetration = 0, reach = 0;
    double larger() const { return std::max(std::abs(penetration), std::abs(reach)); }
  };
  /// A part of a node's reaction.
  struct Part {
    std::size_t node = 0;
    double part = 1;
  };
  /// Returns the nodes whose reactions a node shows, weighted by `amount`: its own, or those of the nodes on which it hangs. The
  /// latter are nodes of the larger cell alone, and the line of contact may lie in the smaller ones.
  std::vector<Part> reactions_at(std::size_t node, double amount) const;
  /// Makes the amounts of all items parts of each node's reaction, with sum 1 (collective).
  template <class Item>
  void share_reactions(std::vector<Item>& items) const;
  /// A point of a crossed cell next to a touching node, where the shell is deepest inside the obstacle.
  struct Deepest {
    std::size_t crossed = 0;  ///< index of the crossed cell
    std::size_t obstacle = 0;
    std::size_t direction = 0;  ///< direction from the node to the point, index of `between_`
    Eigen::Index point = 0;
    double gap = 0;                 ///< < 0 [m]
    bool on_line = true;            ///< true in a zone without area
    std::vector<Part> reactions{};  ///< at this point; other points have the rest
  };
  /// A touching node at a line or point of contact with a sharp edge of an obstacle, in one of its crossed cells.
  struct AtSharpEdge {
    std::size_t crossed = 0, obstacle = 0, node = 0;
    std::vector<Eigen::Vector2d> edges{};  ///< places of the edge in the cell, on either side of the node
    std::vector<Part> reactions{};         ///< in this cell; other cells have the rest
  };
  void find_sharp_edges();
  bool is_at_sharp_edge(std::size_t node, std::size_t obstacle) const {
    return sharp_.local()[node * static_cast<std::size_t>(sharp_.block()) + obstacle] > 0;
  }
  /// The places where the obstacle's normal turns sharply, between node i of line j along a direction and its neighbours.
  std::vector<Eigen::Vector2d> sharp_edges(std::size_t cell, std::size_t obstacle, std::size_t direction, std::size_t i,
                                           std::size_t j) const;
  /// Sum of parts of nodal reactions, of densities by local node and obstacle [N].
  double reaction(const std::vector<Part>& parts, std::size_t obstacle, const std::vector<double>& densities) const;
  double reach_at(const AtSharpEdge& at, const Dual& dual) const;
  void find_deepest();
  void find_held();
  bool is_held(std::size_t node, std::size_t obstacle) const;
  /// Whether all nodes of a cell touch or are held.
  bool reaches_support(std::size_t cell, std::size_t obstacle) const;
  std::optional<double> place_at_support(std::size_t cell, std::size_t obstacle, int across) const;
  Products products(const Dual& dual, std::size_t obstacle, const obstacle::Gap& gap, double mu, double eta,
                    double opened, double opened_by_dual) const;
  std::vector<double> line_shares(const Dual& dual) const;
  std::vector<double> densities(const algebra::Vector& multiplier) const;
  void extend_to_held_nodes(std::size_t cell, std::size_t obstacle, Eigen::MatrixXd& densities) const;
  double share(std::size_t cell, std::size_t obstacle, const Dual& dual) const;
  /// Whether a node touches a rigid obstacle: the pressure of a bed has no jump at the edge of its zone.
  bool touches(std::size_t node, std::size_t obstacle) const {
    return !solved_.discrete.obstacles.all[obstacle].has_bed() && width_->touches(node, obstacle);
  }
  /// Whether all touching nodes of a cell lie on a rim that carries a line reaction.
  bool stands_on_rim(std::size_t cell, std::size_t obstacle) const;
  /// Whether a side of the cell on the rim has both touching and free nodes.
  bool has_end_of_line(std::size_t cell, std::size_t obstacle) const;
  void find_rim();

  const Solved& solved_;
  std::vector<double> eta_{};       ///< the solution's reactions by local node and obstacle, per unit area
  std::vector<char> is_pressed_{};  ///< by obstacle: a force presses it
  std::optional<solution::ContactWidth> width_{};  ///< empty without obstacles
  std::vector<std::size_t> crossed_{}, touching_nodes_{};
  std::vector<int> across_{};
  std::vector<std::optional<double>> at_support_{};
  algebra::Vector held_{};  ///< 1 where supports leave the gap no freedom (block: obstacles)
  /// 1 for local nodes on the rim; empty without a line reaction.
  std::vector<char> on_rim_{};
  std::vector<std::pair<std::size_t, int>> rim_sides_{};  ///< sides of owned cells on the rim; likewise
  Eigen::MatrixXd reaction_basis_;
  std::array<element::BasisAt, 2> between_{};  ///< points between nodes along either direction; empty in triangles
  algebra::Vector sharp_{};  ///< positive at lines and points of contact with sharp edges (block: obstacles)
  std::vector<AtSharpEdge> at_sharp_edges_{};
  bool has_kinks_ = false;
  std::vector<Deepest> deepest_{};
};

}  // namespace plastron::estimation
