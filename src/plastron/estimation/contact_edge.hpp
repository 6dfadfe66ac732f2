// What the edge of a contact zone adds to the error of a functional. It lies somewhere inside of the cells that it crosses, where the
// reaction jumps and nothing is smooth; two terms there are multipliers times how far nodes fail to speak for what is between them,
//   < mu, g(u_h) >   and   < eta, B z_h - w >,
// mu and eta the reactions of dual and solution, g(u_h) the gap, w the values at which the dual is held. Like the product of strain errors
// they are known by size, not by sign (docs/methods/estimates.md). A true line of contact lies between nodes, where the shell found is inside of
// the obstacle beside the row of nodes that touches; nodal quadrature sees nothing of that, and both terms are taken at that point.
#pragma once
#include <plastron/estimation/derivatives.hpp>

#include <array>
#include <utility>
#include <vector>

namespace plastron::estimation {

/// Shares of the crossed cells, without signs.
struct EdgeShares {
  explicit EdgeShares(std::size_t cells) : all(cells, 0), lines(cells, 0) {}
  std::vector<double> all;    ///< the largest of all terms
  std::vector<double> lines;  ///< those of lines of contact alone
};

class ContactEdge {
 public:
  explicit ContactEdge(const Solved& solved);

  /// Owned cells in which some nodes touch an obstacle and some do not, ascending. Where the shell stands on its rim, as a line reaction tells,
  /// cells that touch with nodes of the rim alone have no edge inside: they are crossed if the line ends on one of their sides.
  const std::vector<std::size_t>& crossed() const { return crossed_; }
  /// How many nodes of each of those touch, of the first obstacle that one is crossed for. Where between nodes the edge lies decides about the sign of what it adds: cells of one number err
  /// to the same side, as all cells along a straight edge do, others by chance.
  const std::vector<std::size_t>& touching_nodes() const { return touching_nodes_; }
  /// Along which of its directions, 0 or 1, more neighbouring nodes of each of those differ in touching: the edge runs across it. 0 in triangles.
  const std::vector<int>& across() const { return across_; }
  /// `y` are the Cartesian values of z (collective).
  EdgeShares shares(const Derivative& derivative, const algebra::Vector& z, const algebra::Vector& y) const;

 private:
  struct Reactions {
    std::vector<double> mu, eta;  ///< by local node and obstacle, per unit area
  };
  /// A point of a crossed cell next to a touching node, where the shell is deepest inside of the obstacle.
  struct Deepest {
    std::size_t crossed = 0;  ///< which of these
    std::size_t obstacle = 0, node = 0;
    std::size_t direction = 0;  ///< from the node to the point, and which of `between_`
    Eigen::Index point = 0;
    double gap = 0;       ///< < 0 [m]
    double part = 1;      ///< of the node's reaction: other cells have the rest
    bool on_line = true;  ///< of a zone without area
  };
  /// By node and obstacle, positive in these zones.
  struct Zones {
    algebra::Vector with_area;  ///< they fill a cell, or are wider than e/2
    algebra::Vector wide;       ///< they have a cell away from their edge
  };
  /// (collective)
  Zones zones() const;
  /// Whether a row of touching nodes of the cell, taken across the zone, is longer than e/2.
  bool is_wider_than_a_line(std::size_t cell, std::size_t obstacle) const;
  void find_deepest();
  /// Gaps of the shell at points of a cell, and where they are.
  std::vector<std::pair<double, obstacle::Gap>> gaps(std::size_t cell, std::size_t obstacle,
                                                     const element::BasisAt& at) const;
  std::vector<double> line_shares(const Derivative& derivative, const algebra::Vector& y,
                                  const Reactions& reactions) const;
  std::vector<double> densities(const algebra::Vector& multiplier) const;
  double share(std::size_t cell, std::size_t obstacle, const Derivative& derivative, const element::CellField& z,
               const Reactions& reactions) const;
  int direction_across(std::size_t cell, std::size_t obstacle) const;
  bool touches(std::size_t node, std::size_t obstacle) const;
  /// Whether all nodes of a cell that touch lie on the rim, which carries a line reaction.
  bool stands_on_rim(std::size_t cell, std::size_t obstacle) const;
  /// Whether some nodes of a side of the cell on the rim touch and some do not.
  bool has_end_of_line(std::size_t cell, std::size_t obstacle) const;
  void find_rim();

  const Solved& solved_;
  std::vector<double> eta_{};
  std::vector<std::size_t> crossed_{}, touching_nodes_{};
  std::vector<int> across_{};
  std::vector<char> on_rim_{};                            ///< of local nodes; empty where no line reaction is
  std::vector<std::pair<std::size_t, int>> rim_sides_{};  ///< of owned cells; likewise
  Eigen::MatrixXd reaction_basis_;
  std::array<element::BasisAt, 2> between_{};  ///< points between nodes along either direction; none in triangles
  std::vector<Deepest> deepest_{};
};

}  // namespace plastron::estimation
